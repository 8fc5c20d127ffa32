#include "fit/noise.h"

#include "fit/dot.h"

#include <cmath>
#include <utility>

namespace rolling {

std::vector<double> row_norms(const FilterMatrix& E) {
  std::vector<double> norms;
  norms.reserve(E.band_rows());
  FilterMatrix::Row row;
  for (std::size_t i = 0; i < E.band_rows(); ++i) {
    E.row(i, row);
    norms.push_back(std::sqrt(dot(row.values, row.values)));
  }
  return norms;
}

/// Concatenates the results of function(run number, the part of `all` that belongs to the run).
template <typename Number, typename Function>
std::vector<double> Noise::each(std::span<Number> all, std::size_t columns,
                                Function&& function) const {
  std::vector<double> result;
  for (std::size_t r = 0, start = 0; r < E_.size(); start += E_[r++].rows() * columns) {
    std::vector<double> part = function(r, all.subspan(start, E_[r].rows() * columns));
    if (result.empty()) result = std::move(part);
    else result.insert(result.end(), part.begin(), part.end());
  }
  return result;
}

Noise::Noise(std::vector<FilterMatrix> E, std::optional<double> share) : E_(std::move(E)) {
  if (!share) return;
  for (const FilterMatrix& E_of_run : E_) {
    Covariance covariance(E_of_run);
    const double floor = *share * covariance.median_norm();
    whiteners_.emplace_back(std::move(covariance), floor);
  }
}

double Noise::trace() const {
  double sum = 0;
  for (const auto& whitener : whiteners_) sum += whitener.trace();
  return sum;
}

std::vector<std::size_t> Noise::sources() const {
  std::vector<std::size_t> all;
  for (const FilterMatrix& E : E_) all.push_back(E.columns());
  return all;
}

std::vector<double> Noise::without_weights(const std::vector<double>& f) const {
  return each(std::span(f), 1, [&](std::size_t r, std::span<const double> rows) {
    return whiteners_[r].undo(rows);
  });
}

std::vector<double> Noise::through(std::vector<double> Q, std::size_t p) const {
  return each(std::span(Q), p, [&](std::size_t r, std::span<double> rows) {
    if (weighted()) whiteners_[r].apply_transposed(rows, p);
    return E_[r].transposed_times(rows, p);
  });
}

std::vector<double> Noise::meat(std::vector<double> Q, std::size_t p) const {
  return each(std::span(Q), p,
              [&](std::size_t r, std::span<double> rows) { return whiteners_[r].meat(rows, p); });
}

std::vector<double> Noise::explain(std::vector<double> f) const { return through(std::move(f), 1); }

std::vector<double> Noise::innovations(const std::vector<double>& f,
                                       std::vector<std::size_t>& runs) const {
  return each(std::span(f), 1, [&](std::size_t r, std::span<const double> rows) {
    std::vector<double> few;
    few.reserve(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (whiteners_[r].informative(i)) few.push_back(rows[i]);
    runs.push_back(few.size());
    return few;
  });
}

}  // namespace rolling
