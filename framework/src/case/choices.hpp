// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Choices of a case that are neither numbers nor plugins, with their names in case files.
#pragma once

#include "periporo/material_response.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace periporo {

/// When families are found anew.
enum class RefreshRule { when_needed, every_step };
/// Where the pore pressure comes from.
enum class WaterKind { dry, uniform, hydrostatic, field };
/// The effective stress at the start.
enum class InitialStressKind { zero, geostatic };
/// How points lie in a body.
enum class FillKind { lattice, jittered, relaxed };
/// The axes of the lattice: those of the geometry itself, or the coordinate axes.
enum class LatticeAxes { body, axes };
/// What makes images of points.
enum class ImageKind { symmetry, periodic };
/// How the motion of points is prescribed.
enum class HeldKind { fixed, roller, moving };
enum class StageType { quasi_static, dynamic };

/// Names of the values of an enum. A new value is added to the enum and here.
template <class Choice>
struct ChoiceNames;
template <>
struct ChoiceNames<RefreshRule> {
    static constexpr std::array names{std::pair{RefreshRule::when_needed, "when_needed"},
                                      std::pair{RefreshRule::every_step, "every_step"}};
};
template <>
struct ChoiceNames<WaterKind> {
    static constexpr std::array names{std::pair{WaterKind::dry, "dry"}, std::pair{WaterKind::uniform, "uniform"},
                                      std::pair{WaterKind::hydrostatic, "hydrostatic"},
                                      std::pair{WaterKind::field, "field"}};
};
template <>
struct ChoiceNames<InitialStressKind> {
    static constexpr std::array names{std::pair{InitialStressKind::zero, "zero"},
                                      std::pair{InitialStressKind::geostatic, "geostatic"}};
};
template <>
struct ChoiceNames<FillKind> {
    static constexpr std::array names{std::pair{FillKind::lattice, "lattice"},
                                      std::pair{FillKind::jittered, "jittered"},
                                      std::pair{FillKind::relaxed, "relaxed"}};
};
template <>
struct ChoiceNames<LatticeAxes> {
    static constexpr std::array names{std::pair{LatticeAxes::body, "body"}, std::pair{LatticeAxes::axes, "axes"}};
};
template <>
struct ChoiceNames<ImageKind> {
    static constexpr std::array names{std::pair{ImageKind::symmetry, "symmetry"},
                                      std::pair{ImageKind::periodic, "periodic"}};
};
template <>
struct ChoiceNames<HeldKind> {
    static constexpr std::array names{std::pair{HeldKind::fixed, "fixed"}, std::pair{HeldKind::roller, "roller"},
                                      std::pair{HeldKind::moving, "moving"}};
};
template <>
struct ChoiceNames<StageType> {
    static constexpr std::array names{std::pair{StageType::quasi_static, "quasi_static"},
                                      std::pair{StageType::dynamic, "dynamic"}};
};
template <>
struct ChoiceNames<MaterialResponse> {
    static constexpr std::array names{std::pair{MaterialResponse::elastic, "elastic"},
                                      std::pair{MaterialResponse::full, "full"}};
};

/// All names of an enum, in their order.
template <class Choice>
std::vector<std::string> choice_names()
{
    std::vector<std::string> names;
    for (const auto& [value, name] : ChoiceNames<Choice>::names)
        names.emplace_back(name);
    return names;
}

/// The name of a value.
template <class Choice>
const char* name_of(Choice choice)
{
    return std::ranges::find(ChoiceNames<Choice>::names, choice, [](const auto& one) { return one.first; })->second;
}

/// The value of a name. @throws std::invalid_argument for a name that is none of choice_names()
template <class Choice>
Choice choice_of(const std::string& name)
{
    for (const auto& [value, known] : ChoiceNames<Choice>::names)
        if (name == known)
            return value;
    throw std::invalid_argument("\"" + name + "\" is no choice here");
}

} // namespace periporo
