"""A scene of point lights in POV-Ray's language, for Whitted ray tracing. POV-Ray is left-handed as we are."""
import math

# Nearer to a lamp than any surface is, so that POV-Ray's 2 / (1 + (d / FADE)^2) is the inverse square.
FADE = 0.01


def vector(v, scale=1.0):
    return "<" + ", ".join(f"{scale * c:.9g}" for c in v) + ">"


def sphere_of(sphere):
    ours = sphere["material"]
    ball = lambda size, look: f"sphere {{ {vector(sphere['centre'])}, {size * sphere['radius']:.9g} {look} }}"
    if any(sphere["emission"]):
        raise ValueError("no translation for lamps with an area")
    if ours["type"] == "diffuse":
        return ball(1, f"pigment {{ rgb {vector(ours['rho'])} }} finish {{ diffuse 1 ambient 0 }}")
    if ours["type"] == "fresnel dielectric":
        # POV-Ray's shadow rays pass through what is transparent, ours do not: a second sphere casts the shadow alone.
        return (ball(1, f"pigment {{ rgb {vector(ours['rhoT'])} filter 1 }} interior {{ ior {ours['eta']:.9g} }} "
                        "finish { diffuse 0 ambient 0 conserve_energy "
                        f"reflection {{ rgb 0, rgb {vector(ours['rhoR'])} fresnel on }} }}")
                + "\n" + ball(0.9999, "pigment { rgb 0 } no_image no_reflection"))
    return ball(1, f"pigment {{ rgb 0 }} finish {{ diffuse 0 ambient 0 reflection {{ rgb {vector(ours['rho'])} }} }}")


def translate(scene):
    camera = scene["camera"]
    lines = ["#version 3.7;",
             f"global_settings {{ assumed_gamma 1 max_trace_level {scene['depth']} adc_bailout 1e-5 }}",
             f"background {{ rgb {vector(scene['background'])} }}",
             f"camera {{ location {vector(camera['position'])} right {vector(camera['right'])} "
             f"up {vector(camera['up'])} "
             f"direction {vector(camera['ahead'], 0.5 / math.tan(math.radians(camera['fov'] / 2)))} }}"]
    for lamp in scene["lamps"]:
        # Ours is rho / pi * power * cos / d^2, POV-Ray's rho * colour * cos * 2 FADE^2 / d^2.
        lines.append(f"light_source {{ {vector(lamp['position'])} rgb "
                     f"{vector(lamp['power'], 1 / (2 * math.pi * FADE ** 2))} fade_distance {FADE} fade_power 2 }}")
    return "\n".join(lines + [sphere_of(sphere) for sphere in scene["spheres"]]) + "\n"
