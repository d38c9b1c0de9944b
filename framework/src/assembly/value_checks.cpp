// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "assembly/value_checks.hpp"

#include "assembly/held_points.hpp"
#include "contact/rigid_contact_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

namespace periporo {
namespace {

constexpr double earth = 9.80665;            ///< [m/s2]
constexpr double weakest_gravity = 2e-3;     ///< of the earth's: asteroids have less [-]
constexpr double highest_K0 = 5.0;           ///< of a heavily overconsolidated clay it is 2 to 3 [-]
constexpr double loosest_soil = 0.95;        ///< porosity of peat and of diatomite is up to 0.9 [-]
constexpr double strongest_centrifuge = 500; ///< geotechnical ones reach 300 times gravity [-]
constexpr double lightest_solid = 50.0;      ///< grains of foam are lighter [kg/m3]
constexpr double heaviest_solid = 23000.0;   ///< osmium has 22,600 [kg/m3]
constexpr double fastest_wave = 18500.0;     ///< in diamond [m/s]
constexpr double stiff_contact = 1000.0;     ///< over the body's; a step of a body alone would be 30 times as long
/// The norm of unbalanced forces is what is left of sums of bond forces. They are rounded at 2e-16 and exceed the
/// weight of a point a thousandfold or more.
constexpr double least_residual = 1e-12;

using Texts = std::vector<std::string>;

void check_acceleration(const CaseDescription& description, Texts& suspicions)
{
    const double g = description.gravity.norm();
    if (g > strongest_centrifuge * earth)
        suspicions.push_back(suspicion(description, "gravity",
                                       fmt::format("gravity is {:.4g} m/s2, {:.0f} times that of the earth, 9.81 m/s2; "
                                                   "no centrifuge for soil has that",
                                                   g, g / earth)));
    if (g > 0.0 && g < weakest_gravity * earth)
        suspicions.push_back(suspicion(description, "gravity",
                                       fmt::format("gravity is {:.4g} m/s2, {:.1e} times that of the earth, 9.81 m/s2; "
                                                   "leave it zero for none",
                                                   g, g / earth)));
}

void check_initial_stress(const CaseDescription& description, const BodyDescription& body, Texts& suspicions)
{
    const InitialStressDescription& stress = body.initial_stress;
    if (stress.kind == InitialStressKind::geostatic && stress.lateral_coefficient > highest_K0)
        suspicions.push_back(suspicion(
            description, fmt::format("body.{}.initial_stress", body.name),
            fmt::format("K0 of body '{}' is {:.4g}; soils have 0.3 to 3", body.name, stress.lateral_coefficient)));
}

void check_porosity(const CaseDescription& description, const MaterialDescription& material, Texts& suspicions)
{
    if (material.porosity > loosest_soil)
        suspicions.push_back(
            suspicion(description, fmt::format("material.{}.porosity", material.name),
                      fmt::format("the porosity of material '{}' is {:.4g}: nearly all of it is pores; "
                                  "soils have 0.2 to 0.6, peat up to 0.9",
                                  material.name, material.porosity)));
}

void check_density(const CaseDescription& description, const MaterialDescription& material, Texts& suspicions)
{
    const double density = material.grain_density;
    if (density >= lightest_solid && density <= heaviest_solid)
        return;
    const char* why =
        density < lightest_solid ? "lighter than any mineral (2.65 g/cm3 are 2650 kg/m3)" : "heavier than any metal";
    suspicions.push_back(suspicion(description, fmt::format("material.{}.grain_density", material.name),
                                   fmt::format("the grains of material '{}' have {:.4g} kg/m3, {}; minerals have 2200 "
                                               "to 3000 kg/m3",
                                               material.name, density, why)));
}

void check_moduli(const CaseDescription& description, const Body& body, const BodyDescription& described,
                  double density, Texts& suspicions)
{
    const double bulk = body.material->bulk_modulus(), shear = body.material->shear_modulus();
    const std::string key = fmt::format("material.{}.shear_modulus", described.material);
    const double poisson = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
    const std::string moduli = fmt::format("material '{}' has a bulk modulus of {:.4g} Pa and a shear modulus of "
                                           "{:.4g} Pa",
                                           described.material, bulk, shear);
    if (!(bulk > 0.0 && shear >= 0.0))
        throw refusal(description, key, moduli + ": a material with one below zero is unstable",
                      "Poisson's ratio is between -1 and 0.5");
    if (poisson < 0.0)
        suspicions.push_back(suspicion(description, key,
                                       fmt::format("{}, so that Poisson's ratio is {:.3g}; soil and rock have 0.1 to "
                                                   "0.45, where the shear modulus is 0.1 to 0.9 of the bulk modulus",
                                                   moduli, poisson)));
    const double wave = std::sqrt((bulk + 4.0 / 3.0 * shear) / density);
    if (wave > fastest_wave)
        suspicions.push_back(suspicion(description, fmt::format("material.{}.bulk_modulus", described.material),
                                       fmt::format("{} at {:.4g} kg/m3, so that waves run at {:.4g} m/s; soil has 100 "
                                                   "to 2000 m/s, rock up to 7000 m/s",
                                                   moduli, density, wave)));
}

/// Stiffness of one contact at half its reach, of a point against its like or a rigid surface [N/m].
double stiffness_of(const ContactAssignment& contact, double volume, double mass)
{
    const bool rigid = at_rigid_surface(contact);
    const double reach = contact.law->cutoff();
    const std::array<ContactPair, 1> pairs{{{.distance = 0.5 * reach,
                                             .approach_speed = 0.0,
                                             .volume_a = volume,
                                             .volume_b = rigid ? 0.0 : volume,
                                             .mass_a = mass,
                                             .mass_b = rigid ? 0.0 : mass}}};
    std::array<ContactResponse, 1> responses{};
    contact.law->evaluate(pairs, responses);
    return responses[0].stiffness;
}

/// What the checks need to know of a body as a whole.
struct Extent {
    double volume = 0.0;                                    ///< of its smallest point [m3]
    double mass = 0.0;                                      ///< of that point [kg]
    double least = std::numeric_limits<double>::infinity(); ///< coordinates along `up` [m]
    double most = -std::numeric_limits<double>::infinity();
    bool moves = false; ///< has a velocity at the start
};

std::vector<Extent> extents_of(const Model& model, const Vector3& up)
{
    std::vector<Extent> extents(model.state.bodies.size());
    for (std::size_t i = 0; i < model.size(); ++i) {
        Extent& extent = extents[model.state.points.body[i]];
        const double height = model.state.points.position[i].dot(up);
        if (extent.volume == 0.0 || model.state.points.volume[i] < extent.volume) {
            extent.volume = model.state.points.volume[i];
            extent.mass = model.state.points.mass[i];
        }
        extent.least = std::min(extent.least, height);
        extent.most = std::max(extent.most, height);
        extent.moves = extent.moves || !model.state.points.velocity[i].isZero();
    }
    return extents;
}

void check_contact(const BuiltModel& built, const CaseDescription& description, std::size_t c,
                   const std::vector<Extent>& extents, Texts& suspicions)
{
    const Model& model = built.model;
    const ContactAssignment& contact = built.contacts[c];
    const std::string key = fmt::format("contact.{}", c);
    for (std::size_t n = 0; n < contact.bodies.size(); ++n) {
        const std::uint32_t b = contact.bodies[n];
        if (n > 0 && b == contact.bodies[0])
            continue;
        const Extent& extent = extents[b];
        const Material& material = *model.state.bodies[b].material;
        const double own = (material.bulk_modulus() + 4.0 / 3.0 * material.shear_modulus()) * model.state.spacing;
        const double stiffness = stiffness_of(contact, extent.volume, extent.mass);
        if (stiffness > stiff_contact * own)
            suspicions.push_back(suspicion(
                description, key,
                fmt::format(
                    "a contact of law '{}' has a stiffness of {:.4g} N/m, {:.3g} times that of body '{}' over a "
                    "spacing: the time step has to be about {:.0f} times as short as the body needs; a tenth "
                    "of the body's stiffness is usual",
                    description.contacts[c].law.name, stiffness, stiffness / own, model.state.bodies[b].name,
                    std::sqrt(stiffness / own))));
    }
}

/// How far a body is from the nearest thing that a contact lets it touch, beyond the distance of first points [m].
std::optional<double> gap_below(const BuiltModel& built, std::uint32_t body, const std::vector<Extent>& extents)
{
    const Model& model = built.model;
    std::optional<double> gap;
    const auto note = [&](double found) { gap = gap ? std::min(*gap, found) : found; };
    for (const ContactAssignment& contact : built.contacts) {
        if (!names(contact, body) || within_one_body(contact))
            continue;
        if (!at_rigid_surface(contact)) {
            const std::uint32_t other = contact.bodies[contact.bodies[0] == body ? 1 : 0];
            // The boxes of bodies beside each other overlap in height; then nothing is known of the gap.
            note(extents[body].least - extents[other].most - model.state.spacing);
            continue;
        }
        const RigidContactSurface surface(model, contact);
        if (!surface.present())
            continue;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < model.size(); ++i)
            if (Vector3 normal; model.state.points.body[i] == body)
                nearest = std::min(nearest, surface.distance(model.state.points.position[i], normal));
        note(nearest - 0.5 * model.state.spacing);
    }
    return gap;
}

bool is_held(const BuiltModel& built, const CaseDescription& description, std::uint32_t body)
{
    if (built.model.state.bodies[body].has_standing_water())
        return true;
    for (std::size_t r = 0; r < description.held_regions.size(); ++r)
        if (applies_in(description.held_regions[r].stages, description.stages.front()) &&
            std::ranges::any_of(built.held_regions[r],
                                [&](std::uint32_t i) { return built.model.state.points.body[i] == body; }))
            return true;
    return false;
}

/// A body that hangs higher above what it touches than it is high itself was meant to stand on it, or to be thrown.
void check_fall(const BuiltModel& built, const CaseDescription& description, const std::vector<Extent>& extents,
                Texts& suspicions)
{
    const double g = description.gravity.norm();
    for (std::uint32_t b = 0; b < extents.size() && g > 0.0; ++b) {
        if (extents[b].moves || is_held(built, description, b))
            continue;
        const double height = extents[b].most - extents[b].least + built.model.state.spacing;
        const std::optional<double> gap = gap_below(built, b, extents);
        if (!gap || *gap <= height)
            continue;
        suspicions.push_back(suspicion(
            description, "body." + built.model.state.bodies[b].name + ".geometry",
            fmt::format("body '{}' begins {:.4g} m away from all that it may touch, and is {:.4g} m high: it falls for "
                        "{:.3g} s and meets it at {:.3g} m/s or more; a body that stands on something begins there",
                        built.model.state.bodies[b].name, *gap, height, std::sqrt(2.0 * *gap / g),
                        std::sqrt(2.0 * g * *gap))));
    }
}

/// A speed of rest above every speed of a fall through the model ends a stage as soon as it may end.
void check_rest_speeds(const CaseDescription& description, double height, Texts& suspicions)
{
    const double fall = std::sqrt(2.0 * description.gravity.norm() * height);
    for (std::size_t s = 0; s < description.stages.size() && fall > 0.0; ++s)
        if (const std::optional<double>& speed = description.stages[s].rest_speed; speed && *speed > fall)
            suspicions.push_back(suspicion(
                description, fmt::format("stage.{}.until.rest_speed", s),
                fmt::format("stage '{}' counts everything below {:.4g} m/s as at rest, and a fall through the "
                            "height of the model ends at {:.4g} m/s; a hundredth of that is usual",
                            description.stages[s].name, *speed, fall)));
}

void check_residuals(const CaseDescription& description, Texts& suspicions)
{
    for (std::size_t s = 0; s < description.stages.size(); ++s) {
        const StageDescription& stage = description.stages[s];
        if (stage.residual < least_residual)
            suspicions.push_back(
                suspicion(description, fmt::format("stage.{}.until.residual", s),
                          fmt::format("stage '{}' ends at a residual of {:.3g}, which double precision does not reach: "
                                      "unbalanced forces are rounded at about {:.0e} of gravity; 1e-3 to 1e-5 is usual",
                                      stage.name, stage.residual, least_residual)));
    }
}

} // namespace

void check_values(const BuiltModel& built, const CaseDescription& description, Refusals& refusals, Texts& suspicions)
{
    const double g = description.gravity.norm();
    const Vector3 up = g > 0.0 ? Vector3(-description.gravity / g) : Vector3::UnitZ();
    const std::vector<Extent> extents = extents_of(built.model, up);
    check_acceleration(description, suspicions);
    for (const MaterialDescription& material : description.materials) {
        check_density(description, material, suspicions);
        check_porosity(description, material, suspicions);
    }
    for (const BodyDescription& body : description.bodies)
        check_initial_stress(description, body, suspicions);
    std::vector<std::string> told;
    for (std::size_t b = 0; b < extents.size(); ++b) {
        const BodyDescription& body = description.bodies[b];
        if (std::ranges::find(told, body.material) != told.end())
            continue;
        told.push_back(body.material);
        refusals.attempt("material." + body.material, [&] {
            check_moduli(description, built.model.state.bodies[b], body, extents[b].mass / extents[b].volume,
                         suspicions);
        });
    }
    for (std::size_t c = 0; c < built.contacts.size(); ++c)
        check_contact(built, description, c, extents, suspicions);
    check_fall(built, description, extents, suspicions);
    double lowest = extents.front().least, highest = extents.front().most;
    for (const Extent& extent : extents) {
        lowest = std::min(lowest, extent.least);
        highest = std::max(highest, extent.most);
    }
    check_rest_speeds(description, highest - lowest + built.model.state.spacing, suspicions);
    check_residuals(description, suspicions);
}

} // namespace periporo
