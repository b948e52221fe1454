// Tail probabilities of the normal, Student and chi-square distributions, and thresholds for many tests at once.
//
// Tails are computed as tails: never 1 - (something near 1), because a family of thousands of tests lives out there.
#pragma once

#include <cstddef>

namespace orrery::statistics {

/// P(Z > z) for a standard normal Z.
double normal_upper_tail(double z);

/// The z with P(Z > z) = tail, 0 < tail < 1. To rounding for every tail a double can hold.
double normal_upper_quantile(double tail);

/// The |z| that one of `tests` independent standard normals exceeds with probability `alpha` in all (Sidak).
/// Positively dependent tests (the channels of a pixel) raise fewer alarms than that, never more.
double family_threshold(double alpha, std::size_t tests);

/// Q(a, x) = Gamma(a, x) / Gamma(a), the regularised upper incomplete gamma function; a > 0, x >= 0.
double gamma_upper(double a, double x);

/// I_x(a, b), the regularised incomplete beta function; a, b > 0, 0 <= x <= 1.
double beta_regularised(double a, double b, double x);

/// P(X > statistic) for a chi-square X.
double chi_square_upper_tail(double statistic, double degrees);

/// P(|T| > |t|) for a Student T; `degrees` may be infinite.
double student_two_sided(double t, double degrees);

/// The normal score whose two-sided tail is that of `t` under Student's distribution, with the sign of t.
/// Scores from variances known to different degrees become comparable with one threshold. Saturates near 38, where
/// the tail leaves the range of a double.
double normal_equivalent(double t, double degrees);

}  // namespace orrery::statistics
