// Fresnel's reflectance and Snell's direction: the maths body every instruction set shares, against angles in double.
#include "kernels/lobes.hpp"

#include <gtest/gtest.h>

#include "numbers.hpp"
#include "optics_reference.hpp"

namespace orrery::kernel_tests {
namespace {

using V = kernels::ScalarLanes<float>;
using kernels::Vec3;

kernels::Interface<V> interface_at(double cosine, double eta) {
    return kernels::interface_at<V>(narrow(cosine), narrow(eta));
}

const double etas[] = {0.05, 0.4, 1 / 1.5, 0.99, 0.9999, 1, 1.0001, 1.01, 1.33, 1.5, 2.42, 20};

TEST(Fresnel, ReflectanceFollowsTheSineAndTangentLaws) {
    for (const double wide_eta : etas) {
        const double eta = narrow(wide_eta);
        for (int i = 0; i <= 2000; ++i) {
            const double cosine = narrow(i / 2000.0);
            const auto at = interface_at(cosine, eta);
            const double cosine_t = transmitted_cosine(cosine, eta);
            // Near the critical angle the reflectance goes with the square root of what rounding leaves of cos^2.
            const double slack = 1e-6 + 1e-6 / std::max(eta * cosine_t, 1e-3);
            ASSERT_NEAR(at.reflectance, fresnel(cosine, eta), slack) << "eta " << eta << ", cosine " << cosine;
            ASSERT_GE(at.reflectance, 0.0f);
            ASSERT_LE(at.reflectance, 1.0f);
            ASSERT_NEAR(at.cosine_t, cosine_t, slack / std::min(1.0, eta)) << "eta " << eta << ", cosine " << cosine;
            ASSERT_NEAR(at.inverse_eta, 1 / eta, 1e-7 / eta);
        }
    }
}

TEST(Fresnel, TotalInternalReflectionIsTotal) {
    const double eta = 1 / 1.5, critical = std::sqrt(1 - eta * eta);
    for (int i = 0; i <= 1000; ++i) {
        const auto at = interface_at(0.99999 * critical * i / 1000, eta);
        ASSERT_EQ(at.reflectance, 1.0f);
        ASSERT_EQ(at.cosine_t, 0.0f);
    }
    EXPECT_LT(interface_at(1.01 * critical, eta).reflectance, 0.7f);
}

TEST(Fresnel, NoInterfaceReflectsNothing) {
    for (int i = 1; i <= 1000; ++i) {
        const auto at = interface_at(i / 1000.0, 1);
        ASSERT_LT(at.reflectance, 1e-12f);
        ASSERT_NEAR(at.cosine_t, i / 1000.0, 1e-7);
    }
}

TEST(Fresnel, GrazingLightIsAllReflected) {
    for (const double eta : etas) {
        EXPECT_EQ(interface_at(0, eta).reflectance, 1.0f) << eta;
        if (eta != 1) {
            EXPECT_GT(interface_at(1e-8, eta).reflectance, 0.999f) << eta;
        }
    }
}

TEST(Fresnel, IsTheSameFromBothSides) {
    for (const double eta : {1.01, 1.33, 1.5, 2.42})
        for (int i = 1; i <= 100; ++i) {
            const auto in = interface_at(i / 100.0, eta);
            const auto out = interface_at(in.cosine_t, 1 / eta);
            ASSERT_NEAR(in.reflectance, out.reflectance, 1e-5 + 3e-6 / (i / 100.0));
        }
}

TEST(Fresnel, RefractedAndReflectedDirections) {
    Numbers random(1);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 n = random.direction();
        glm::dvec3 d = random.direction();
        if (glm::dot(d, n) > 0) d = -d;
        const double eta = random.scale(0.4, 2.5), cosine = -glm::dot(d, n);
        const Vec3<float> fd{narrow(d.x), narrow(d.y), narrow(d.z)}, fn{narrow(n.x), narrow(n.y), narrow(n.z)};
        const auto r = kernels::reflected(fd, fn, narrow(cosine));
        ASSERT_LT(glm::length(glm::dvec3(r.x, r.y, r.z) - mirror(d, n)), 5e-7);
        const double cosine_t = transmitted_cosine(cosine, eta);
        if (cosine_t == 0) continue;
        const auto t = kernels::refracted<V>(fd, fn, narrow(cosine), interface_at(cosine, eta));
        ASSERT_LT(glm::length(glm::dvec3(t.x, t.y, t.z) - refract(d, n, eta)),
                  1e-6 / std::min(1.0, eta) / std::max(eta * cosine_t, 1e-3));
    }
}

}  // namespace
}  // namespace orrery::kernel_tests
