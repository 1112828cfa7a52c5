#pragma once

#include "inference/person_rows.h"
#include "inference/random_intercept.h"

#include <memory>

namespace obscura {

// A binomial regression as a model of people for RandomIntercept; parameters are the coefficients.
// This class works for every link. `rows` must outlive it.
class BinomialPersons : public ShiftedModel {
  public:
    BinomialPersons(const PersonRows& rows, Link link);

    int persons() const override { return rows_.persons(); }
    bool setParameters(const Eigen::VectorXd& coefficients) override;
    ShiftedRows at(int person, double shift) const override;
    void atNodes(int person, const Eigen::ArrayXd& shifts, Eigen::ArrayXd& values,
                 Eigen::ArrayXd& slopes) override;
    void addGradient(int person, const GradientParts& parts, Eigen::VectorXd& gradient) override;

  protected:
    // Curvature, information and its derivative of one row; all that the gradient asks of it.
    virtual Evidence atMode(Eigen::Index row, double shift) const { return rowAt(row, shift); }

    Evidence rowAt(Eigen::Index row, double shift) const {
        return evidence(link_, predictor_[row] + shift, successes(row), trials(row));
    }
    Eigen::Index first(int person) const { return rows_.first[static_cast<std::size_t>(person)]; }
    double successes(Eigen::Index row) const { return rows_.data.successes[row]; }
    double trials(Eigen::Index row) const { return rows_.data.trials[row]; }
    void resizeNodeSlopes(Eigen::Index nodes, Eigen::Index rows);

    const PersonRows& rows_;
    Link link_;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> design_;
    Eigen::VectorXd predictor_;
    Eigen::ArrayXXd nodeSlopes_; // nodes x rows of the last person
};

// The fastest of these for a link.
std::unique_ptr<BinomialPersons> binomialModel(const PersonRows& rows, Link link);

} // namespace obscura
