// Where two spheres all but touch: what float leaves in doubt, of the light or of the picture.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "plan/contacts.hpp"
#include "worlds.hpp"

namespace orrery::test {
namespace {

using enum MaterialKind;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Looks at the origin from a distance, from above.
Scene seen_from(double distance) {
    Scene scene = empty_world();
    scene.camera.position = distance * dvec3{0, 0.6, -0.8};
    scene.camera.target = {0, 0, 0};
    scene.camera.fov = 30;
    scene.settings.width = scene.settings.height = 256;
    return scene;
}

Primitive& put(Scene& scene, const char* id, const dvec3& centre, double radius, MaterialKind kind = diffuse) {
    Primitive& p = add(scene, kind);
    p.id = id, p.centre = centre, p.radius = radius;
    return p;
}

bool in_doubt(const Scene& scene) { return uncertain_contact(scene, Precision::binary32).has_value(); }

/// A lamp of radius 600 shows its lowest part through a ceiling 10 above, from inside the ceiling's ball or outside it.
Scene lamp_through(double ceiling, double depth, bool around) {
    Scene scene = seen_from(5);
    put(scene, "floor", {0, -1000, 0}, 1000);
    put(scene, "ceiling", {0, around ? 10 + ceiling : 10 - ceiling, 0}, ceiling);
    put(scene, "lamp", {0, 610 - depth, 0}, 600).emission = dvec3{1};
    return scene;
}

// Of a cap of height h rounding by e changes e/h: at radius 1e5, where e is 0.006, a 500th of 3.
TEST(Contacts, OfALampThatShowsItsCapCountByItsHeight) {
    for (const bool around : {true, false}) {
        for (const double depth : {0.02, 0.1, 0.27, 0.5, 2.0}) EXPECT_TRUE(in_doubt(lamp_through(1e5, depth, around)));
        for (const double depth : {7.0, 9.0}) EXPECT_FALSE(in_doubt(lamp_through(1e5, depth, around))) << around;
        EXPECT_TRUE(in_doubt(lamp_through(1e4, 0.1, around)));
        EXPECT_FALSE(in_doubt(lamp_through(1e4, 2, around)));
        EXPECT_TRUE(in_doubt(lamp_through(1e5, 0, around))) << "it just does not show, by the last bit";
        EXPECT_FALSE(in_doubt(lamp_through(1e5, -1, around))) << "it does not show";
    }
    const auto words = uncertain_contact(lamp_through(1e5, 0.27, true), Precision::binary32);
    EXPECT_EQ(words,
              "spheres \"lamp\" and \"ceiling\" overlap by 0.27, where surfaces are good to 0.006: 2 % of the light is "
              "in doubt");
    for (const bool around : {true, false})
        EXPECT_FALSE(uncertain_contact(lamp_through(1e6, 0.02, around), Precision::binary64));
}

TEST(Contacts, OfALampBesideAGreatOneDoNotCount) {
    Scene scene = lamp_through(1e4, 0.1, false);
    ASSERT_TRUE(in_doubt(scene));
    put(scene, "sun", {0, 5, 3}, 1).emission = dvec3{1e6};
    scene.camera.position = {0, 3, -300};  // from where the cap does not look large either
    EXPECT_FALSE(in_doubt(scene));
}

// A ball that lies on the floor, or hangs from the ceiling: real scenes are full of them.
TEST(Contacts, OfBallsOnAFloorAreHarmless) {
    for (const MaterialKind kind : all_kinds) {
        for (const double sunk : {0.0, 1e-5, -1e-5, 1e-3}) {
            Scene scene = seen_from(8);
            put(scene, "floor", {0, -500, 0}, 500);
            put(scene, "ball", {0, 1.5 - sunk, 0}, 1.5, kind);
            EXPECT_FALSE(in_doubt(scene));
            scene.primitives[1].emission = dvec3{10};
            EXPECT_FALSE(in_doubt(scene));
        }
    }
}

TEST(Contacts, OfACrystalAreHarmless) {
    Scene scene = seen_from(30);
    for (int i = 0; i < 729; ++i)
        put(scene, "", dvec3{i % 9, i / 9 % 9, i / 81} - 4.0, 0.5, i % 2 == 0 ? diffuse : dielectric);
    EXPECT_FALSE(in_doubt(scene));
}

// The top of a large ball breaks through the ground: its rim moves by far more than the surfaces.
TEST(Contacts, OfAHillCountByWhatIsSeenOfThem) {
    const auto hill = [](double ground, double radius, double height, double from) {
        Scene scene = seen_from(from);
        put(scene, "ground", {0, -ground, 0}, ground);
        put(scene, "hill", {0, height - radius, 0}, radius);
        return scene;
    };
    EXPECT_TRUE(in_doubt(hill(1e5, 600, 0.05, 20)));
    EXPECT_TRUE(in_doubt(hill(1e4, 1000, 0.005, 7)));
    EXPECT_FALSE(in_doubt(hill(1e5, 600, 0.05, 4000))) << "from afar";
    EXPECT_FALSE(in_doubt(hill(1e3, 6, 0.005, 4))) << "a small one";
    EXPECT_FALSE(in_doubt(hill(1e5, 600, -1, 20))) << "beneath the ground";
}

TEST(Contacts, BetweenTransparentSurfacesCountMore) {
    const auto pair = [](double shift, MaterialKind kind) {
        Scene scene = seen_from(4);
        put(scene, "a", {0, 0, 0}, 1, kind);
        put(scene, "b", {shift, 0, 0}, 1, kind);
        return scene;
    };
    for (const MaterialKind kind : {diffuse, dielectric}) {
        EXPECT_TRUE(in_doubt(pair(1e-6, kind)));
        EXPECT_TRUE(in_doubt(pair(1e-5, kind)));
        EXPECT_FALSE(in_doubt(pair(0.1, kind)));
    }
    EXPECT_TRUE(in_doubt(pair(5e-5, dielectric)));
    EXPECT_FALSE(in_doubt(pair(2e-4, diffuse)));
}

// Two walls and a slit between them, beyond which there is light.
TEST(Contacts, OfWallsCountByTheSlitBetweenThem) {
    const auto walls = [](double radius, double gap, double from) {
        Scene scene = seen_from(1);
        scene.camera.position = {0, 0, -from};
        put(scene, "upper", {0, radius + gap / 2, 0}, radius);
        put(scene, "lower", {0, -radius - gap / 2, 0}, radius);
        return scene;
    };
    EXPECT_TRUE(in_doubt(walls(1e5, 0.05, 100)));
    EXPECT_TRUE(in_doubt(walls(1e5, 0, 100)));
    EXPECT_FALSE(in_doubt(walls(1e5, 10, 100)));
    EXPECT_FALSE(in_doubt(walls(1e2, 0.01, 10)));
}

}  // namespace
}  // namespace orrery::test
