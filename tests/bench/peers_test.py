"""Whether other renderers get all of a scene, with stand-ins for Blender's modules: none need be installed."""
import json
import sys
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench" / "peers"))


class Vector(list):
    to_track_quat = __sub__ = __neg__ = lambda self, *_: self


bpy = mock.MagicMock()
sys.modules |= {"bpy": bpy, "mathutils": mock.MagicMock(Vector=Vector)}
import blender
import povray
import race
import scene

SCENES = sorted((ROOT / "scenes").glob("assignment_*.json"))


def listed(path):
    """What the file composes, read in another way: the spheres' centres, which of them are lamps, the point lights."""
    root = json.loads(path.read_text(encoding="utf-8"))
    find = lambda kind, name: next(entry for entry in root[kind] if entry["id"] == name)
    pairs = [(find("shapes", one["shape"]), one["type"] == "emissive") for one in root["scene"]["primitives"]]
    points = [find("lights", name) for name in root["scene"]["lights"]]
    return ({tuple(shape["centre"]) for shape, _ in pairs}, {tuple(shape["centre"]) for shape, lamp in pairs if lamp},
            [light["position"] for light in points if light["type"] == "point"])


class Peers(unittest.TestCase):
    def test_scene_is_whole(self):
        self.assertEqual(len(SCENES), 8)
        for path in SCENES:
            spheres, lamps, points = listed(path)
            found = scene.read(path)
            self.assertEqual(sorted(tuple(one["centre"]) for one in found["spheres"]), sorted(spheres))
            self.assertEqual({tuple(one["centre"]) for one in found["spheres"] if any(one["emission"])}, lamps)
            self.assertEqual([one["position"] for one in found["lamps"]], points)
            self.assertTrue(lamps or points)

    def test_camera_is_left_handed(self):
        camera = scene.read(SCENES[0])["camera"]
        self.assertEqual([camera["right"], camera["up"], camera["ahead"]], [[1, 0, 0], [0, 1, 0], [0, 0, 1]])

    def test_povray_gets_all(self):
        for path in SCENES:
            spheres, lamps, points = listed(path)
            if lamps:
                self.assertRaises(ValueError, povray.translate, scene.read(path))
                continue
            text = povray.translate(scene.read(path))
            for centre in spheres:
                self.assertIn(f"sphere {{ {povray.vector(centre)}, ", text)
            self.assertEqual(text.count("light_source"), len(points))

    def test_blender_gets_all(self):
        for path in SCENES:
            spheres, lamps, points = listed(path)
            for setting, meshes in (("mesh", len(spheres)), ("point", len(spheres) - len(lamps))):
                bpy.reset_mock()
                blender.build(scene.read(path), setting)
                self.assertEqual(bpy.ops.mesh.primitive_uv_sphere_add.call_count, meshes)
                self.assertEqual(bpy.data.lights.new.call_count, len(points) + len(spheres) - meshes)

    def test_samples_for_an_error(self):
        errors = [2 / n ** 0.5 if n < 9 else 6 / n for n in race.OURS]
        for n in race.OURS + (0.25, 2, 20, 100):
            self.assertAlmostEqual(race.samples_for(2 / n ** 0.5 if n < 9 else 6 / n, errors), n)


unittest.main()
