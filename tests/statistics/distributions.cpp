#include "statistics/distributions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace orrery::statistics {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double tiny = 1e-300;     // keeps Lentz's recurrences off zero
constexpr int most_terms = 100000;  // both expansions need O(sqrt(a)) terms; this is a guard, not a tuning

void require(bool condition, const char* what) {
    if (!condition) throw std::invalid_argument(what);
}

// Lentz's evaluation of b0 + a1/(b1 + a2/(b2 + ...)): multiply successive convergents' ratios until they are 1.
class ContinuedFraction {
public:
    explicit ContinuedFraction(double b0) : value_(b0 == 0 ? tiny : b0), c_(value_) {}

    /// Takes one more term; true once it no longer matters.
    bool add(double a, double b) {
        d_ = 1 / away_from_zero(b + a * d_);
        c_ = away_from_zero(b + a / c_);
        value_ *= c_ * d_;
        return std::abs(c_ * d_ - 1) < epsilon;
    }
    double value() const { return value_; }

private:
    static double away_from_zero(double x) { return std::abs(x) < tiny ? tiny : x; }
    double value_, c_, d_ = 0;
};

// I_x(a, b) where its continued fraction converges fast: x below the mean (a+1)/(a+b+2).
double beta_by_fraction(double a, double b, double x) {
    const double front =
        std::exp(a * std::log(x) + b * std::log1p(-x) + std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b)) / a;
    ContinuedFraction fraction(1);
    fraction.add(-(a + b) * x / (a + 1), 1);
    for (int m = 1; m < most_terms; ++m) {
        fraction.add(m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)), 1);
        if (fraction.add(-(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)), 1)) break;
    }
    return front / fraction.value();
}

}  // namespace

double normal_upper_tail(double z) { return 0.5 * std::erfc(z / std::numbers::sqrt2); }

double normal_upper_quantile(double tail) {
    require(tail > 0 && tail < 1, "normal_upper_quantile: tail outside (0, 1)");
    if (tail > 0.5) return -normal_upper_quantile(1 - tail);
    // Bisection: slower than a rational approximation with a page of constants, and there is nothing to get wrong.
    double low = 0, high = 40;
    for (double middle = 20; low < middle && middle < high; middle = 0.5 * (low + high)) {
        (normal_upper_tail(middle) > tail ? low : high) = middle;
    }
    return low;
}

double family_threshold(double alpha, std::size_t tests) {
    require(alpha > 0 && alpha < 1 && tests > 0, "family_threshold: alpha outside (0, 1) or no test");
    const double each = -std::expm1(std::log1p(-alpha) / static_cast<double>(tests));
    return normal_upper_quantile(each / 2);
}

double gamma_upper(double a, double x) {
    require(a > 0 && x >= 0, "gamma_upper: a <= 0 or x < 0");
    if (x == 0) return 1;
    const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (int n = 1; n < most_terms && term > sum * epsilon; ++n) sum += term *= x / (a + n);
        return 1 - front * sum;
    }
    ContinuedFraction fraction(x + 1 - a);
    for (int n = 1; n < most_terms; ++n) {
        if (fraction.add(n * (a - n), x + 1 - a + 2 * n)) break;
    }
    return front / fraction.value();
}

double beta_regularised(double a, double b, double x) {
    require(a > 0 && b > 0 && x >= 0 && x <= 1, "beta_regularised: outside its domain");
    if (x == 0 || x == 1) return x;
    return x < (a + 1) / (a + b + 2) ? beta_by_fraction(a, b, x) : 1 - beta_by_fraction(b, a, 1 - x);
}

double chi_square_upper_tail(double statistic, double degrees) { return gamma_upper(degrees / 2, statistic / 2); }

double student_two_sided(double t, double degrees) {
    // Beyond 1e7 degrees the two agree to 1e-4 of the tail at 6 sigma, and the fraction for beta needs many terms.
    if (degrees > 1e7) return std::erfc(std::abs(t) / std::numbers::sqrt2);
    require(degrees > 0, "student_two_sided: no degree of freedom");
    return beta_regularised(degrees / 2, 0.5, degrees / (degrees + t * t));
}

double normal_equivalent(double t, double degrees) {
    const double tail = std::max(student_two_sided(t, degrees), std::numeric_limits<double>::min());
    return tail >= 1 ? 0.0 : std::copysign(normal_upper_quantile(tail / 2), t);
}

}  // namespace orrery::statistics
