# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Breaks the operator, the water, contact and the checkpoints on purpose and demands that a test notices.

A mutation replaces one text in one source. The mutated source is compiled with the command of the build, linked in
front of the framework's library into a test program, and one test of the program must report a failed check.
"""
from __future__ import annotations

import argparse
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Mutation:
    """What is broken, and who must see it."""

    source: str  # below framework/src, compiled anew
    text: str  # stands exactly once in `place`
    becomes: str
    test: str  # test that must fail, by its name in ctest
    header: str = ""  # where the text stands, when not in the source itself

    @property
    def place(self) -> str:
        return self.header or self.source

    @property
    def program(self) -> str:
        return self.test.rpartition(".")[0]

    @property
    def test_source(self) -> str:
        return self.test.rpartition(".")[2] + ".cpp"


_IDENTITIES = "properties.operator_identities_test"
_REFRESH = "unit.operator.refresh_test"
_WATER = "unit.water.water_test"
_STANDING_WATER = "unit.water.standing_water_test"
_CONTACT_KINDS = "unit.contact.contact_kinds_test"
_SMOOTHED_SURFACE = "unit.contact.smoothed_surface_test"

MUTATIONS = {
    "influence_dropped_from_the_force": Mutation(
        "operator/sub_horizon.cpp",
        "const Pack weight = omega * load_pack(&w.volume[at]) * self_volume;",
        "const Pack weight = load_pack(&w.volume[at]) * self_volume;",
        _IDENTITIES,
    ),
    "influence_dropped_from_the_projected_force": Mutation(
        "operator/bond_projection.cpp", "const Pack weight = g.omega * g.volume * self_volume;", "const Pack weight = g.volume * self_volume;", _IDENTITIES
    ),
    "shares_that_do_not_sum_to_one": Mutation(
        "operator/sub_horizon.cpp",
        "total > 0.0 ? 1.0 / total : 0.0",
        "total > 0.0 ? 0.99 / total : 0.0",
        _IDENTITIES,
    ),
    "shares_of_inactive_bonds_handed_on": Mutation(
        "operator/sub_horizon.cpp",
        "total += select(lane_mask(family.lanes(p)), whole, zero);",
        "total += select(active, whole, zero);",
        _IDENTITIES,
    ),
    "bond_force_left_in_the_moments": Mutation(
        "operator/sub_horizon.cpp",
        "share -= dyad(along, zeta);",
        "",
        _IDENTITIES,
    ),
    "bond_motion_over_its_own_length": Mutation(
        "operator/sub_horizon.cpp",
        "maximum(dot(zeta, zeta), Pack(least_squared))",
        "dot(zeta, zeta)",
        _IDENTITIES,
    ),
    "transposed_gradient": Mutation(
        "operator/sub_horizon.cpp",
        "{s[6], s[7], s[8], s[9], s[10], s[11], s[12], s[13], s[14]}",
        "{s[6], s[9], s[12], s[7], s[10], s[13], s[8], s[11], s[14]}",
        _IDENTITIES,
    ),
    "reversed_spin": Mutation(
        "operator/sub_horizon.cpp",
        "const Real quarter = 0.25 * time_step;",
        "const Real quarter = -0.25 * time_step;",
        _REFRESH,
        header="operator/bond_update.hpp",
    ),
    "bond_state_lost_at_refresh": Mutation(
        "operator/refresh.cpp",
        "while (at < before.count && families_before",
        "at = before.count;\nwhile (at < before.count && families_before",
        _REFRESH,
    ),
    "point_variables_not_evened_out": Mutation(
        "operator/refresh.cpp",
        "bond[r * pack_width] = initial_on_bond(model.bonds, states, i, neighbour, r);",
        "static_cast<void>(initial_on_bond(model.bonds, states, i, neighbour, r));",
        _REFRESH,
    ),
    "image_reaction_not_mirrored": Mutation(
        "operator/bond_forces.cpp", "if (part.isometry != 0)", "if (false)", _IDENTITIES
    ),
    "pair_taken_for_sound": Mutation(
        "operator/sub_horizon.cpp",
        "det > singular_shape_quality * mean",
        "det > 0.0 * mean",
        "properties.degenerate_families_test",
    ),
    "no_pressure_below_the_water_table": Mutation(
        "water/pressure_field.cpp",
        "return std::max(slope_ * (level_ - place[axis_]), -largest_);",
        "return std::min(0.0, std::max(slope_ * (level_ - place[axis_]), -largest_));",
        _WATER,
    ),
    "given_saturation_below_the_water_table": Mutation(
        "water/water.cpp", "std::lerp(points.saturation[point], 1.0, soaked)", "points.saturation[point]", _WATER
    ),
    "soil_drains_when_it_leaves_the_water": Mutation(
        "water/water.cpp", "changes ? share : std::max(course_.soaked[i], share)", "changes ? share : share", _WATER
    ),
    "pores_that_open_under_water_stay_empty": Mutation(
        "water/water.cpp",
        "std::max(grains, points.volume[point]) - grains - held",
        "points.initial_volume[point] - grains - held",
        _WATER,
    ),
    "water_level_lost_at_resume": Mutation(
        "water/water.cpp",
        "set_durations(stage);\n    for (std::size_t b = 0; b < bodies_.size(); ++b)\n        model.state.bodies[b].water_level = level(b);",
        "set_durations(stage);",
        _WATER,
    ),
    "weight_of_new_water_from_the_start_of_the_step": Mutation(
        "water/water.cpp",
        "points.position[i] + 0.5 * time_step * mid_velocity",
        "points.position[i] + 0.0 * mid_velocity",
        _WATER,
    ),
    "no_lift": Mutation("water/standing_water.cpp", "force[i] += now * water.up();", "", _STANDING_WATER),
    "lift_at_once_at_the_surface": Mutation(
        "water/standing_water.cpp",
        "std::clamp(0.5 - height / model_.state.spacing, 0.0, 1.0)",
        "(height < 0.0 ? 1.0 : 0.0)",
        _STANDING_WATER,
        header="water/standing_water.hpp",
    ),
    "work_of_the_lift_from_the_end_of_the_step": Mutation(
        "water/standing_water.cpp", "0.5 * (before + now)", "now", _STANDING_WATER
    ),
    "buoyancy_left_out_of_the_overburden": Mutation(
        "water/overburden.cpp", " - water.buoyancy_of(i)", "", "unit.water.overburden_test"
    ),
    "checksum_of_an_archive_not_verified": Mutation(
        "io/archive.cpp", "if (checksum != stored)", "if (false)", "unit.io.archive_test"
    ),
    "length_of_an_entry_believed": Mutation(
        "io/archive.cpp", "if (entry.count > (end - entry.offset) / size)", "if (false)", "unit.io.archive_test"
    ),
    "damaged_checkpoint_left_in_its_place": Mutation(
        "io/checkpoint.cpp",
        "rename_file(folder / checkpoint_name, folder / damaged_checkpoint_name);",
        "fs::exists(folder);",
        "unit.io.checkpoint_test",
    ),
    "energy_stored_in_contacts_lost_at_resume": Mutation(
        "contact/rigid_surface_contact.cpp",
        "if (stored_points_.size() != stored_energies_.size() ||",
        "stored_points_.clear();\n    stored_energies_.clear();\n    if (stored_points_.size() != stored_energies_.size() ||",
        "unit.time.obstacle_corners_test",
    ),
    "contacts_of_images_not_counted": Mutation(
        "contact/point_contact.cpp", "model.neighbourhood.fill_images(contacts_of_);", "", _CONTACT_KINDS
    ),
    "reach_of_images_lost": Mutation(
        "contact/one_body_contact.cpp", "model.neighbourhood.fill_images(reach_of_end_);", "", _CONTACT_KINDS
    ),
    "images_of_detached_points_taken_for_bonded": Mutation(
        "contact/one_body_contact.cpp", "model.neighbourhood.fill_images(detached_);", "", _CONTACT_KINDS
    ),
    "load_on_images_of_a_surface_lost": Mutation(
        "contact/smoothed_surface_contact.cpp",
        "model.neighbourhood.fill_images(total_slope_);",
        "",
        _SMOOTHED_SURFACE,
    ),
    "energy_of_lost_support_not_dissipated": Mutation(
        "contact/contact_forces.cpp",
        "dissipated += std::max(0.0, stored_before_[i] - stored_after_[i]);",
        "",
        _SMOOTHED_SURFACE,
    ),
}


def _run(command: str, folder: Path) -> subprocess.CompletedProcess:
    return subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True, check=False)


def _must(command: str, folder: Path) -> str:
    done = _run(command, folder)
    if done.returncode != 0:
        sys.exit(f"this command of the build failed:\n{command}\n{done.stdout}{done.stderr}")
    return done.stdout


def _build_commands(build: Path, target: str) -> list[str]:
    return _must(f"ninja -t commands {shlex.quote(target)}", build).strip().splitlines()


def _write_mutated(mutation: Mutation, source: Path, folder: Path) -> Path:
    """The mutated file, below `folder` as it was below framework/src."""
    text = (source / "framework/src" / mutation.place).read_text()
    if text.count(mutation.text) != 1:
        sys.exit(f"{mutation.place} holds this {text.count(mutation.text)} times instead of once:\n{mutation.text}")
    mutated = folder / mutation.place
    mutated.parent.mkdir(parents=True, exist_ok=True)
    mutated.write_text(text.replace(mutation.text, mutation.becomes))
    # a header beside the source would be found before the mutated one: the source comes along
    if mutation.header:
        (folder / mutation.source).write_text((source / "framework/src" / mutation.source).read_text())
    return folder / mutation.source


def _compile(original: str, file: Path, folder: Path, commands: list[str], build: Path) -> Path:
    """Compiles `file` with the command by which the build compiles `original`."""
    command = next(c for c in commands if f"-c {original}" in c)
    words = shlex.split(command)
    words = [w for n, w in enumerate(words) if not w.startswith("-M") and words[n - 1] not in ("-MF", "-MT")]
    output = folder / "mutated.o"
    words[words.index("-o") + 1] = str(output)
    words[words.index("-c") + 1] = str(file)
    first_option = next(n for n, w in enumerate(words) if w.startswith("-"))  # behind the compiler and its launcher
    words.insert(first_option, f"-I{folder}")
    words.append("-w")  # what a mutation leaves unused is no fault
    _must(shlex.join(words), build)
    return output


def survives(name: str, source: Path, build: Path) -> bool:
    """True when the test program passes all the same."""
    mutation = MUTATIONS[name]
    folder = build / "mutations" / name
    commands = _build_commands(build, f"bin/{mutation.program}")
    file = _write_mutated(mutation, source, folder)
    mutated = _compile(str(source / "framework/src" / mutation.source), file, folder, commands, build)
    program = folder / mutation.program
    library = "framework/libperiporo_framework.a"
    link = commands[-1].replace(library, f"{mutated} {library}", 1)
    link = link.replace(f"-o bin/{mutation.program}", f"-o {program}", 1)
    _must(link, build)
    outcome = _run(f"{shlex.quote(str(program))} --source-file='*/{mutation.test_source}'", build)
    print(outcome.stdout[-3000:])
    if outcome.returncode not in (0, 1) or not re.search(r"\[doctest\] test cases: +[1-9]", outcome.stdout):
        sys.exit(f"{mutation.test} did not run to its end: status {outcome.returncode}\n{outcome.stderr}")
    return outcome.returncode == 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--list", action="store_true", help="print the names of the mutations")
    parser.add_argument("--source", type=Path, help="the source tree")
    parser.add_argument("--build", type=Path, help="the build folder, a Ninja one")
    parser.add_argument("name", nargs="?", choices=MUTATIONS)
    options = parser.parse_args()
    if options.list:
        print("\n".join(MUTATIONS))
        return 0
    if survives(options.name, options.source, options.build):
        print(f"{options.name}: {MUTATIONS[options.name].test} passes although this is broken")
        return 1
    print(f"{options.name}: noticed by {MUTATIONS[options.name].test}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
