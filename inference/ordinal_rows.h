#pragma once

#include "inference/interval_evidence.h"
#include "inference/ordinal_data.h"
#include "inference/person_rows.h"
#include "inference/random_intercept.h"

#include <utility>

namespace obscura {

// A cumulative link model as a model of people for RandomIntercept; parameters are thresholds, then
// coefficients. `data` must outlive it.
class OrdinalRows : public ShiftedModel {
  public:
    OrdinalRows(const OrdinalData& data, PersonOrder order, Eigen::Index thresholds, Link link)
        : data_(data), order_(std::move(order)), thresholds_(thresholds), link_(link) {}

    int persons() const override { return static_cast<int>(order_.first.size()) - 1; }
    bool setParameters(const Eigen::VectorXd& parameters) override;
    ShiftedRows at(int person, double shift) const override;
    void atNodes(int person, const Eigen::ArrayXd& shifts, Eigen::ArrayXd& values,
                 Eigen::ArrayXd& slopes) override;
    void addGradient(int person, const GradientParts& parts, Eigen::VectorXd& gradient) override;

    // Log-likelihood of all rows without people, with its gradient.
    double withoutPeople(const Eigen::VectorXd& parameters, Eigen::VectorXd& gradient);

  private:
    Eigen::Index first(int person) const { return order_.first[static_cast<std::size_t>(person)]; }
    Eigen::Index row(Eigen::Index position) const {
        return order_.rows[static_cast<std::size_t>(position)];
    }
    Eigen::Index category(Eigen::Index row) const {
        return data_.category[static_cast<std::size_t>(row)];
    }
    IntervalEvidence evidenceOf(Eigen::Index row, double shift) const;
    // The parts of a row's gradient by its two ends, taken to thresholds and coefficients.
    void addRow(Eigen::Index row, double upper, double lower, Eigen::VectorXd& gradient) const;

    const OrdinalData& data_;
    PersonOrder order_;
    Eigen::Index thresholds_;
    Link link_;
    Eigen::VectorXd parameters_, predictor_;
};

} // namespace obscura
