// Fresnel, Snell and the glossy lobe in double, from angles: not the forms the kernels use.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace orrery::kernel_tests {

inline constexpr double pi = std::numbers::pi;

/// Unpolarised reflectance by Fresnel's sine and tangent laws. `eta`: transmitted index over incident.
inline double fresnel(double cosine, double eta) {
    const double i = std::acos(std::min(cosine, 1.0)), sine_t = std::sin(i) / eta;
    if (sine_t >= 1) return 1;
    const double t = std::asin(sine_t);
    if (i < 1e-6) return (eta - 1) * (eta - 1) / ((eta + 1) * (eta + 1));  // both laws are 0/0 there
    const double s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
    return (s * s + p * p) / 2;
}

/// Cosine of the transmitted ray, 0 where there is none.
inline double transmitted_cosine(double cosine, double eta) {
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)) / eta;
    return sine >= 1 ? 0 : std::cos(std::asin(sine));
}

/// Direction of the transmitted ray: in the plane of incidence, at the angle Snell says. `n` on the incident side.
inline glm::dvec3 refract(const glm::dvec3& d, const glm::dvec3& n, double eta) {
    const glm::dvec3 tangent = d - glm::dot(d, n) * n;
    const double sine = glm::length(tangent) / eta;
    const glm::dvec3 across = sine > 0 ? glm::normalize(tangent) * sine : glm::dvec3(0);
    return across - n * std::sqrt(std::max(0.0, 1 - sine * sine));
}

inline glm::dvec3 mirror(const glm::dvec3& d, const glm::dvec3& n) { return d - 2 * glm::dot(d, n) * n; }

/// Sine of the angle between two unit vectors, good near 0.
inline double sine_between(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(glm::cross(a, b)); }

/// Density of the glossy lobe (output/REPORT.md, task 3) at the angle theta from R, before conditioning.
inline double lobe_density(double theta, double beta) {
    const double sine = std::sin(theta);
    if (theta >= pi / 2 || sine >= beta) return 0;
    return (std::cos(2 * theta) + beta * beta) / (2 * pi * beta * std::sqrt(beta * beta - sine * sine));
}

/// Probability that R + beta S leaves on the reflecting side.
inline double lobe_side_probability(double lobe_dot_n, double beta) {
    return (1 + std::min(1.0, lobe_dot_n / beta)) / 2;
}

/// Conditioned density of `direction`.
inline double glossy_density(const glm::dvec3& lobe, const glm::dvec3& n, double beta, const glm::dvec3& direction) {
    if (glm::dot(direction, n) <= 0 || glm::dot(direction, lobe) <= 0) return 0;
    const double theta = std::asin(std::min(1.0, sine_between(lobe, direction)));
    return lobe_density(theta, beta) / lobe_side_probability(std::max(0.0, glm::dot(lobe, n)), beta);
}

/// How far rounding of float directions may move that density, relatively: it grows without bound towards the edge.
inline double glossy_slack(const glm::dvec3& lobe, double beta, const glm::dvec3& direction) {
    const double sine = sine_between(lobe, direction);
    return 1e-5 + 4e-7 * sine / std::max(beta * beta - sine * sine, 1e-30);
}

/// Two unit vectors that with `axis` form a frame; the first as far towards `towards` as can be.
struct Frame {
    glm::dvec3 x, y, axis;
    Frame(const glm::dvec3& along, const glm::dvec3& towards) : x{}, y{}, axis(along) {
        const glm::dvec3 across = towards - glm::dot(towards, along) * along;
        const glm::dvec3 other = std::abs(along.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        x = glm::length(across) > 1e-9 ? glm::normalize(across) : glm::normalize(glm::cross(along, other));
        y = glm::cross(along, x);
    }
    /// In [-pi, pi], 0 towards x.
    double azimuth(const glm::dvec3& v) const { return std::atan2(glm::dot(v, y), glm::dot(v, x)); }
    glm::dvec3 at(double theta, double phi) const {
        return axis * std::cos(theta) + (x * std::cos(phi) + y * std::sin(phi)) * std::sin(theta);
    }
};

}  // namespace orrery::kernel_tests
