#include "diagnose/proposal/proposal.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tera {
namespace {

constexpr double kConstantRatio = 1e-9;  ///< standard deviation over RMS of a constant column
constexpr double kSameColumnCorrelation = 0.999;  ///< of columns of which one is left out

bool IsAngle(const RegimeVariable& variable, const std::string& channel_unit) {
  const std::string kind = variable.name.substr(0, variable.name.find('/'));
  return variable.angle || kind == "pitch" || kind == "roll" || kind == "slope" ||
         (kind == "position" && channel_unit.starts_with("rad"));
}

/// A variable with its values.
struct Source {
  std::string name;
  const std::vector<double>* value = nullptr;
  bool angle = false;
  bool has_sign = false;  ///< a lever or rate, whose sign is a factor too
};

class Library {
 public:
  explicit Library(std::size_t rows) : rows_(static_cast<Eigen::Index>(rows)) {}

  Eigen::VectorXd Column(const Source& source, FactorForm form) const {
    Eigen::VectorXd column(rows_);
    for (Eigen::Index k = 0; k < rows_; ++k) {
      column[k] = Shaped(form, (*source.value)[static_cast<std::size_t>(k)]);
    }
    return column;
  }
  void Add(std::vector<Factor> factors, Eigen::VectorXd column) {
    const Eigen::VectorXd centred = column.array() - column.mean();
    const double size = centred.norm();
    if (!(size > kConstantRatio * (column.norm() + 1e-300))) return;
    for (const Eigen::VectorXd& earlier : centred_) {
      if (std::abs(centred.dot(earlier)) > kSameColumnCorrelation * size) return;
    }
    centred_.push_back(centred / size);
    terms_.push_back({std::move(factors), std::move(column)});
  }
  void Add(const Source& source, FactorForm form) {
    Add({{source.name, form}}, Column(source, form));
  }
  void Add(const Source& a, FactorForm a_form, const Source& b, FactorForm b_form) {
    Add({{a.name, a_form}, {b.name, b_form}}, Column(a, a_form).cwiseProduct(Column(b, b_form)));
  }
  std::vector<LibraryTerm> Take() { return std::move(terms_); }

 private:
  Eigen::Index rows_;
  std::vector<LibraryTerm> terms_;
  std::vector<Eigen::VectorXd> centred_;
};

void AddAlone(const Source& source, Library* library) {
  using enum FactorForm;
  library->Add(source, kValue);
  if (source.angle) {
    library->Add(source, kSine);
    library->Add(source, kCosine);
    return;
  }
  library->Add(source, kMagnitude);
  if (source.has_sign) library->Add(source, kSign);
  library->Add(source, kSquare);
  library->Add(source, kSignedSquare);
}

void AddProducts(const Source& main, const Source& other, Library* library) {
  using enum FactorForm;
  library->Add(main, kValue, other, kValue);
  if (other.angle) {
    library->Add(main, kValue, other, kSine);
    library->Add(main, kValue, other, kCosine);
  } else {
    library->Add(main, kValue, other, kMagnitude);
  }
}

}  // namespace

void LeastSquares::Add(const LeastSquares& other, double times) {
  if (information.size() == 0) {
    information = Eigen::MatrixXd::Zero(other.information.rows(), other.information.cols());
    pull = Eigen::VectorXd::Zero(other.pull.size());
  }
  information += times * other.information;
  pull += times * other.pull;
  energy += times * other.energy;
  rows += times * other.rows;
}

double Shaped(FactorForm form, double x) {
  switch (form) {
    case FactorForm::kValue:
      return x;
    case FactorForm::kMagnitude:
      return std::abs(x);
    case FactorForm::kSign:
      return x > 0 ? 1 : x < 0 ? -1 : 0;
    case FactorForm::kSquare:
      return x * x;
    case FactorForm::kSignedSquare:
      return x * std::abs(x);
    case FactorForm::kSine:
      return std::sin(x);
    case FactorForm::kCosine:
      return std::cos(x);
  }
  return 0;
}

std::vector<LibraryTerm> TermLibraryOf(const Channel& channel,
                                       const std::vector<double>& predicted) {
  std::vector<Source> sources;
  for (const RegimeVariable& variable : channel.variables) {
    if (variable.name == "time") continue;
    sources.push_back({variable.name, &variable.series.value, IsAngle(variable, channel.unit),
                       variable.name.starts_with("lever")});
  }
  const Source rate{"rate", &predicted, false, true};
  Library library(predicted.size());
  for (const Source& source : sources) AddAlone(source, &library);
  AddAlone(rate, &library);
  for (const Source& source : sources) AddProducts(rate, source, &library);
  for (std::size_t s = 1; s < sources.size(); ++s) AddProducts(sources[0], sources[s], &library);
  for (const Source& source : sources) {
    if (!source.name.starts_with("load")) continue;
    library.Add(rate, FactorForm::kSign, source, FactorForm::kValue);
    library.Add(rate, FactorForm::kSign, source, FactorForm::kMagnitude);
  }
  return library.Take();
}

namespace {

/// Share of FINAL's RMSE that a proposal must remove.
constexpr double kLeastGain = 0.05;

}  // namespace

double RmsOver(const Series& series, const Mask& mask) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    if (!mask[k] || !series.valid[k]) continue;
    sum += series.value[k] * series.value[k];
    ++count;
  }
  return std::sqrt(sum / std::max(count, 1.0));
}

bool Holds(double rmse_before, double rmse_after) {
  return rmse_before > 0 && rmse_after <= (1 - kLeastGain) * rmse_before;
}

}  // namespace tera
