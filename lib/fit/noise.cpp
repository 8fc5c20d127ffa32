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
    norms.push_back(std::sqrt(dot(row.values.data(), row.values.data(), row.values.size())));
  }
  return norms;
}

namespace {

void append(std::vector<double>& to, std::vector<double> more) {
  if (to.empty()) to = std::move(more);
  else to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

Noise::Noise(std::vector<FilterMatrix> E, std::optional<double> share) : E_(std::move(E)) {
  if (!share) return;
  for (const FilterMatrix& of_run : E_) {
    Covariance covariance(of_run);
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
  std::vector<double> all;
  std::size_t start = 0;
  for (std::size_t r = 0; r < E_.size(); start += E_[r++].rows())
    append(all, whiteners_[r].undo(std::span(f).subspan(start, E_[r].rows())));
  return all;
}

std::vector<double> Noise::through(std::vector<double> Q, std::size_t p) const {
  std::vector<double> all;
  std::size_t start = 0;
  for (std::size_t r = 0; r < E_.size(); start += E_[r++].rows()) {
    const auto of_run = std::span(Q).subspan(start * p, E_[r].rows() * p);
    if (weighted()) whiteners_[r].apply_transposed(of_run, p);
    append(all, E_[r].transposed_times(of_run, p));
  }
  return all;
}

std::vector<double> Noise::middle(std::vector<double> Q, std::size_t p) const {
  if (E_.size() == 1) return whiteners_[0].middle(std::move(Q), p);
  std::vector<double> all;
  std::size_t start = 0;
  for (std::size_t r = 0; r < E_.size(); start += E_[r++].rows()) {
    const auto from = Q.begin() + static_cast<std::ptrdiff_t>(start * p),
               to = from + static_cast<std::ptrdiff_t>(E_[r].rows() * p);
    append(all, whiteners_[r].middle(std::vector(from, to), p));
  }
  return all;
}

std::vector<double> Noise::explain(std::vector<double> f) const { return through(std::move(f), 1); }

std::vector<double> Noise::innovations(const std::vector<double>& f,
                                       std::vector<std::size_t>& runs) const {
  std::vector<double> all;
  std::size_t start = 0;
  for (std::size_t r = 0; r < E_.size(); ++r) {
    const std::size_t before = all.size();
    for (std::size_t i = 0; i < E_[r].rows(); ++i)
      if (whiteners_[r].informative(i)) all.push_back(f[start + i]);
    runs.push_back(all.size() - before);
    start += E_[r].rows();
  }
  return all;
}

}  // namespace rolling
