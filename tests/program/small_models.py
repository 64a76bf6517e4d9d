"""Small models of every kind that writes a results file; their runs take a fraction of a second."""

from support import MASTS, OSCILLATORS

_PORTAL = """\
  {name}:
    frame:
      origin: [{x}, 0]
      material: {{E: 30 GPa}}
      grid: {{storeys: 1, bays: 1, storey_height: 3.2 m, bay_width: 6 m, columns: {{rectangle: [0.4, 0.4]}}, beams: {{rectangle: [0.3, 0.5]}}, floor_mass: {mass} t}}
      hinges:
        beams: {{at: both, {beams}}}
        columns: {{at: feet, yield_moment: 90 kN m, hardening: 2 %}}
    damping: 5 %
"""
#: Two colliding frames whose hinges yield by two laws.
HINGES = (
    "ground_motion: {harmonic: {amplitude: 8.0, period: 0.5 s, duration: 0.6 s}}\nstructures:\n"
    + _PORTAL.format(name="left", x=0, mass=40, beams="yield_moment: 60 kN m, hardening: 2 %")
    + _PORTAL.format(
        name="right",
        x=6.005,
        mass=20,
        beams="bouc_wen: {yield_moment: 50 kN m, spring_hardening: 2 %, stiffness_factor: 10}",
    )
    + "links: [{between: [left, right], floors: all, law: hertz_damped, stiffness: 1e9, restitution: 0.65}]\n"
    "analysis: {duration: 0.6 s, tolerance: 1e-4, output_step: 10 ms}\n"
)
#: Two colliding buildings whose storeys yield.
STOREYS = """\
ground_motion: {harmonic: {amplitude: 5.0, period: 0.6, duration: 1.0}}
structures:
  left: {shear_building: {storeys: 2, mass: 200 t, stiffness: [60 MN/m, 50 MN/m], yield_force: [0.9 MN, 0.6 MN], hardening: 0.05}, damping: 5 %}
  right: {shear_building: {storeys: 2, mass: 150 t, stiffness: 300 MN/m, yield_force: 20 MN, hardening: 0.05}, damping: 3 %}
links: [{between: [left, right], floors: all, gap: 20 mm, law: hertz_damped, stiffness: 1e9, restitution: 0.65}]
analysis: {duration: 1.0, tolerance: 1e-4, output_step: 10 ms}
"""
#: A building on isolators that hits a wall with backfill.
ISOLATORS = """\
ground_motion: {harmonic: {amplitude: 6.0, period: 1.2, duration: 1.5}}
structures:
  building:
    shear_building:
      storeys: 2
      mass: [350 t, 250 t]
      stiffness: 500 MN/m
      isolator: {lead_rubber: {strength: 300 kN, yield_displacement: 10 mm, post_yield_stiffness: 8.5 MN/m}, capacity: 600 mm}
    damping: 2 %
  east: {wall: {}}
links:
  - {between: [building.1, east], name: moat, gap: 60 mm, law: backfill, stiffness: 300 MN/m, unloading: 600 MN/m, failure_ratio: 0.75, strength: 4 MN}
analysis: {duration: 1.5, tolerance: 1e-4, output_step: 10 ms}
"""
_TOWER = """\
  {name}:
    frame:
      origin: [{x}, 0]
      material: {{E: 30 GPa}}
      grid: {{storeys: 12, bays: 21, storey_height: 3.2, bay_width: 6, columns: {{rectangle: [{column}, {column}]}}, beams: {{rectangle: [0.3, 0.5]}},
             floor_mass: {mass} t, rigid_floors: false}}
    damping: 5 %
"""
#: Two reduced frames with a few coordinates each.
REDUCED = (
    "ground_motion: {harmonic: {amplitude: -4, period: 0.7, duration: 1}}\nstructures:\n"
    + _TOWER.format(name="left", x=0, column=0.5, mass=60)
    + _TOWER.format(name="right", x=126.0002, column=0.6, mass=20)
    + "links: [{between: [left, right], floors: all, law: hertz_damped, stiffness: 1e9, restitution: 0.6}]\n"
    "analysis: {duration: 0.3, output_step: 10 ms, tolerance: 0.01, reduction: {links: 6, ground: 10}}\n"
)
#: A bar and a damper between two oscillators.
DEVICES = OSCILLATORS.replace(
    "links:\n",
    "devices:\n  tie: {between: [left, right], bar: {stiffness: 2 MN/m}}\n"
    "  brake: {between: [left, right], damper: {coefficient: 200 kN (s/m)^0.5, exponent: 0.5}}\nlinks:\n",
)
#: Models of runs by their kind.
RUNS = {
    "oscillators": OSCILLATORS,
    "hinges": HINGES,
    "storeys": STOREYS,
    "isolators": ISOLATORS,
    "reduced": REDUCED,
    "devices": DEVICES,
    "masts": MASTS,
}
#: Arguments of `pounding pushover` for the model `HINGES`.
PUSH = ("--structure", "left", "--to", "120 mm")
#: 12 rows by the kernel, some of which the solver repeats.
STUDY = """\
ground_motion: {synthetic: {seed: 1, duration: 0.8 s, pga: 0.3 g, soil: firm}}
structures:
  left: {oscillator: {mass: 100 t, period: 0.8 s, damping: 5 %}}
  right: {oscillator: {mass: 150 t, period: 0.4 s, damping: 5 %}}
links: [{between: [left, right], gap: 1 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}]
analysis: {tolerance: 1e-3}
study:
  factors: {gap: {of: links.*.gap, list: [1 mm, 3 mm]}}
  records: {synthetic: {count: 3, duration: 0.8 s, pga: 0.3 g}}
  intensity: {measure: pga, levels: [0.2 g, 0.4 g]}
  keep: [displacement, force, impacts]
"""
