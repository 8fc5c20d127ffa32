// What a filter, or a chain of filters, makes of its raw column, as a matrix.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace rolling {

/// A matrix whose rows are zero outside a short stretch: what a filter does to a column.
class BandMatrix {
 public:
  BandMatrix() = default;
  static BandMatrix identity(std::size_t n);
  bool is_identity() const;
  /// Makes room for so many rows of so many numbers in all.
  void reserve(std::size_t rows, std::size_t numbers);
  /// Appends a row; zeros at either end of it are not stored, and equal rows, one after another,
  /// share their numbers.
  void append(std::size_t first, std::span<const double> values);
  std::size_t rows() const { return rows_.size(); }
  /// One more than the last column that a row reaches.
  std::size_t columns() const { return columns_; }
  std::size_t first(std::size_t i) const { return rows_[i].first; }
  std::size_t end(std::size_t i) const { return rows_[i].first + rows_[i].size; }
  std::span<const double> row(std::size_t i) const {
    return {values_.data() + rows_[i].start, rows_[i].size};
  }
  /// So many columns, counted back from the last one that it or a row before it reaches, a row
  /// reaches at most.
  std::size_t window() const { return window_; }
  /// These rows, of all the columns.
  BandMatrix of_rows(std::span<const std::size_t> rows) const;

 private:
  struct Row {
    std::uint32_t start, first, size;  // start in values_
  };
  std::vector<Row> rows_;
  std::vector<double> values_;
  std::size_t columns_ = 0, window_ = 0;
};

/// A product of band matrices, the first filter rightmost. It is never multiplied out: one filter
/// after another is narrower than all of them at once. Below it may stand one row that reaches over
/// the whole run (the mean of a column).
class FilterMatrix {
 public:
  FilterMatrix(BandMatrix);
  static FilterMatrix identity(std::size_t n);
  /// L times this matrix.
  FilterMatrix then(BandMatrix L) const;
  /// These rows of it.
  FilterMatrix of_rows(std::span<const std::size_t> rows) const;
  FilterMatrix with_last_row(std::vector<double> row) const;

  std::size_t rows() const { return band_rows() + bordered(); }
  std::size_t columns() const { return columns_; }
  /// Without the last row that reaches over the run.
  std::size_t band_rows() const { return factors_.empty() ? columns_ : factors_.back()->rows(); }
  bool bordered() const { return border_ != nullptr; }
  std::span<const double> last_row() const { return *border_; }

  /// A row of the band, from the first column that it reaches.
  struct Row {
    std::size_t first = 0;
    std::vector<double> values, spare;

    std::size_t end() const { return first + values.size(); }
  };
  /// Writes row i; whoever asks for row after row gives the same place again.
  void row(std::size_t i, Row& to) const;
  std::vector<double> times(std::span<const double> x) const;
  /// The product of the transposed matrix with X, of `columns` numbers a row.
  std::vector<double> transposed_times(std::span<const double> X, std::size_t columns = 1) const;

 private:
  friend class FilterPass;
  explicit FilterMatrix(std::size_t columns) : columns_(columns) {}

  std::size_t columns_;
  std::vector<std::shared_ptr<const BandMatrix>> factors_;  // that of the first filter first
  std::shared_ptr<const std::vector<double>> border_;
};

/// Sends rows of numbers through the filters, one at a time: the product with a matrix of so many
/// columns.
class FilterPass {
 public:
  FilterPass(const FilterMatrix&, std::size_t columns);
  /// So many numbers a row, with room that is not used.
  std::size_t stride() const { return stride_; }
  /// The place for the next row of the raw column, and then takes it from there.
  double* place() { return raw_.data(); }
  void push();
  /// The next row of the product; null as long as it is not known. Valid until the next call.
  double* next();

 private:
  struct Stage {
    const BandMatrix* L;
    std::vector<double> in;  // the rows base .. count - 1 of what comes in
    std::size_t base, count, row;
    std::vector<double> out;
  };
  double* next_of(std::size_t stage);

  const FilterMatrix& H_;
  std::size_t stride_, pushed_ = 0;
  std::vector<double> raw_, last_;
  bool fresh_ = false, last_given_ = false;
  std::vector<Stage> stages_;
};

}  // namespace rolling
