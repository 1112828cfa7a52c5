#pragma once

#include <Eigen/Core>

#include <cmath>

namespace obscura {

// A function's value with its first and second derivatives by N variables: arithmetic on jets is
// the chain rule, so that a likelihood's gradient and Hessian are those of the formula as written.
template <int N>
struct Jet {
    using Vector = Eigen::Matrix<double, N, 1>;
    using Matrix = Eigen::Matrix<double, N, N>;

    double value = 0;
    Vector first = Vector::Zero();
    Matrix second = Matrix::Zero();

    Jet() = default;
    Jet(double constant) : value(constant) {} // NOLINT(google-explicit-constructor): 2 * jet
    static Jet variable(double value, int index) {
        Jet jet(value);
        jet.first(index) = 1;
        return jet;
    }

    // f(jet), from f and its derivatives f1, f2 there.
    Jet through(double f, double f1, double f2) const {
        Jet result(f);
        result.first = f1 * first;
        result.second = f1 * second + f2 * first * first.transpose();
        return result;
    }

    friend Jet operator-(const Jet& a) { return a.through(-a.value, -1, 0); }
    friend Jet operator+(const Jet& a, const Jet& b) {
        Jet sum(a.value + b.value);
        sum.first = a.first + b.first;
        sum.second = a.second + b.second;
        return sum;
    }
    friend Jet operator-(const Jet& a, const Jet& b) { return a + -b; }
    friend Jet operator*(const Jet& a, const Jet& b) {
        Jet product(a.value * b.value);
        product.first = a.value * b.first + b.value * a.first;
        product.second = a.value * b.second + b.value * a.second + a.first * b.first.transpose() +
                         b.first * a.first.transpose();
        return product;
    }
};

template <int N>
Jet<N> exp(const Jet<N>& x) {
    const double e = std::exp(x.value);
    return x.through(e, e, e);
}

// log(1 - e^x), x < 0, without cancellation at either end (Maechler, "Accurately computing
// log(1 - exp(-|a|))", R package Rmpfr, 2012).
template <int N>
Jet<N> log1mExp(const Jet<N>& x) {
    const double e = std::exp(x.value), complement = -std::expm1(x.value);
    const double f = x.value > -0.6931471805599453 ? std::log(complement) : std::log1p(-e);
    const double f1 = -e / complement;
    return x.through(f, f1, f1 / complement);
}

} // namespace obscura
