#include "fit/noise.h"

#include "base/error.h"
#include "fit/dot.h"

#include <algorithm>
#include <cmath>

namespace rolling {

std::vector<double> row_norms(const BandMatrix& E) {
  std::vector<double> norms;
  norms.reserve(E.rows());
  for (std::size_t i = 0; i < E.rows(); ++i)
    norms.push_back(std::sqrt(dot(E.row(i).data(), E.row(i).data(), E.row(i).size())));
  return norms;
}

Noise::Noise(std::vector<Matrix> E, std::optional<double> share, bool border) : E_(std::move(E)) {
  if (!share) return;
  for (const Matrix& of_run : E_) {
    std::vector<double> norms = row_norms(*of_run);
    if (border) norms.pop_back();
    if (norms.empty()) fail("a run has no record that can be fitted");
    const auto middle = norms.begin() + static_cast<std::ptrdiff_t>(norms.size() / 2);
    std::nth_element(norms.begin(), middle, norms.end());
    whiteners_.emplace_back(*of_run, *share * *middle, border);
  }
}

void Noise::weight(std::size_t run, std::span<double> f, std::span<double> J) const {
  whiteners_[run].apply(f);
  whiteners_[run].apply(J);
}

double Noise::log_size() const {
  double sum = 0;
  for (const auto& whitener : whiteners_) sum += whitener.log_size();
  return sum;
}

double Noise::trace() const {
  double sum = 0;
  for (const auto& whitener : whiteners_) sum += whitener.trace();
  return sum;
}

std::vector<std::size_t> Noise::sources() const {
  std::vector<std::size_t> all;
  for (const Matrix& E : E_) all.push_back(E->columns());
  return all;
}

std::vector<double> Noise::through(const std::vector<double>& Q, std::size_t p) const {
  std::vector<double> all;
  std::size_t start = 0;
  for (std::size_t r = 0; r < E_.size(); ++r) {
    const BandMatrix& E = *E_[r];
    const std::size_t before = all.size();
    all.resize(before + E.columns() * p);
    std::vector<double> q(E.rows());
    for (std::size_t j = 0; j < p; ++j) {
      for (std::size_t i = 0; i < q.size(); ++i) q[i] = Q[(start + i) * p + j];
      if (weighted()) whiteners_[r].apply_transposed(q);
      const auto b = E.transposed_times(q);
      for (std::size_t s = 0; s < b.size(); ++s) all[before + s * p + j] = b[s];
    }
    start += q.size();
  }
  return all;
}

std::vector<double> Noise::explain(std::vector<double> f) const {
  std::vector<double> all;
  std::size_t start = 0;
  for (std::size_t r = 0; r < E_.size(); ++r) {
    const std::span<double> of_run = std::span(f).subspan(start, E_[r]->rows());
    whiteners_[r].apply_transposed(of_run);
    const auto e = E_[r]->transposed_times(of_run);
    all.insert(all.end(), e.begin(), e.end());
    start += of_run.size();
  }
  return all;
}

std::vector<double> Noise::innovations(const std::vector<double>& f,
                                       std::vector<std::size_t>& runs) const {
  std::vector<double> all;
  std::size_t start = 0;
  for (std::size_t r = 0; r < E_.size(); ++r) {
    const std::size_t before = all.size();
    for (std::size_t i = 0; i < E_[r]->rows(); ++i)
      if (whiteners_[r].informative(i)) all.push_back(f[start + i]);
    runs.push_back(all.size() - before);
    start += E_[r]->rows();
  }
  return all;
}

}  // namespace rolling
