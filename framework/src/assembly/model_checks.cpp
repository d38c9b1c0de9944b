// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "assembly/model_checks.hpp"

#include "assembly/geometries.hpp"
#include "assembly/gravity_checks.hpp"
#include "assembly/meeting_checks.hpp"
#include "assembly/plane_checks.hpp"
#include "assembly/surface_checks.hpp"
#include "assembly/value_checks.hpp"
#include "case/refusal.hpp"
#include "contact/rigid_contact_surface.hpp"
#include "neighbourhood/cell_list.hpp"
#include "water/pore_stress.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>

namespace periporo {
namespace {

constexpr double coincident = 1e-6;       ///< distance over the spacing below which two points are one
constexpr double high_friction = 2.0;     ///< rock on rock has 0.6 to 1
constexpr double absurd_friction = 100.0; ///< 89.4 degrees

std::string place(const Vector3& x)
{
    return fmt::format("({:.5g}, {:.5g}, {:.5g}) m", x.x(), x.y(), x.z());
}

std::string body_key(const Model& model, std::size_t body)
{
    return "body." + model.state.bodies[body].name;
}

/// The box around the points of a body and, as far as they tell, around the body: half a spacing and a little farther.
Bounds bounds_of(const Model& model, std::size_t body)
{
    Bounds bounds{Vector3::Constant(std::numeric_limits<double>::infinity()),
                  Vector3::Constant(-std::numeric_limits<double>::infinity())};
    for (std::size_t i = 0; i < model.size(); ++i)
        if (model.state.points.body[i] == body) {
            bounds.lower = bounds.lower.cwiseMin(model.state.points.position[i]);
            bounds.upper = bounds.upper.cwiseMax(model.state.points.position[i]);
        }
    bounds.lower.array() -= model.state.spacing;
    bounds.upper.array() += model.state.spacing;
    return bounds;
}

/// Coordinates so large that neighbouring numbers lie farther apart than points may.
void check_resolution(const Model& model, const CaseDescription& description)
{
    for (std::size_t i = 0; i < model.size(); ++i) {
        const double gap =
            model.state.points.position[i].cwiseAbs().maxCoeff() * std::numeric_limits<double>::epsilon();
        if (gap > coincident * model.state.spacing)
            throw refusal(description, body_key(model, model.state.points.body[i]) + ".geometry",
                          fmt::format("points of body '{}' coincide: numbers as large as the coordinates {} lie {:.2g} "
                                      "m apart, and the spacing is {:.4g} m",
                                      model.body_of(i).name, place(model.state.points.position[i]), gap,
                                      model.state.spacing),
                          "move the case nearer to the origin");
    }
}

void check_coincidence(const Model& model, const CaseDescription& description)
{
    const std::vector<Vector3>& x = model.state.points.position;
    const CellList cells(x, model.state.horizon);
    for (std::uint32_t i = 0; i < model.size(); ++i)
        cells.visit_near(x[i], [&](std::uint32_t j) {
            if (j > i && (x[i] - x[j]).norm() < coincident * model.state.spacing)
                throw refusal(description, body_key(model, model.state.points.body[i]) + ".geometry",
                              fmt::format("point {} of body '{}' and point {} of body '{}' coincide at {}",
                                          model.state.points.id[i], model.body_of(i).name, model.state.points.id[j],
                                          model.body_of(j).name, place(x[i])),
                              "every point needs a place of its own");
        });
}

/// A point of one body inside another one: `deep` when a spacing around it is, too.
struct Intruder {
    std::size_t count = 0;
    std::size_t deep = std::numeric_limits<std::size_t>::max();
    std::size_t some = 0;
};

Intruder intruders(const Model& model, std::size_t body, const Bounds& bounds, const Geometry& other)
{
    Intruder found;
    for (std::size_t i = 0; i < model.size(); ++i) {
        const Vector3& x = model.state.points.position[i];
        if (model.state.points.body[i] != body || (x.array() < bounds.lower.array()).any() ||
            (x.array() > bounds.upper.array()).any() || !other.contains(x))
            continue;
        ++found.count;
        found.some = i;
        bool deep = true;
        for (int c = 0; c < 3 && deep; ++c)
            for (const double side : {-model.state.spacing, model.state.spacing})
                deep = deep && other.contains(x + side * Vector3::Unit(c));
        if (deep)
            found.deep = std::min(found.deep, i);
    }
    return found;
}

void check_overlap_of(const Model& model, const CaseDescription& description, std::size_t a, std::size_t b,
                      const Bounds& bounds_b, Geometries& geometries, std::vector<std::string>& suspicions)
{
    const Intruder found = intruders(model, a, bounds_b, *geometries.of_body(b));
    if (found.count == 0)
        return;
    const bool deep = found.deep < model.size();
    const std::string what = fmt::format("{} points of body '{}' lie in body '{}', one of them at {}", found.count,
                                         model.state.bodies[a].name, model.state.bodies[b].name,
                                         place(model.state.points.position[deep ? found.deep : found.some]));
    if (deep)
        throw refusal(description, body_key(model, a) + ".geometry", what, "move one of the bodies, or cut it");
    suspicions.push_back(suspicion(description, body_key(model, a) + ".geometry", what));
}

void check_overlaps(const Model& model, const CaseDescription& description, Geometries& geometries, Refusals& refusals,
                    std::vector<std::string>& suspicions)
{
    std::vector<Bounds> bounds;
    for (std::size_t b = 0; b < model.state.bodies.size(); ++b)
        bounds.push_back(bounds_of(model, b));
    for (std::size_t a = 0; a < bounds.size(); ++a)
        for (std::size_t b = 0; b < bounds.size(); ++b) {
            const bool apart = (bounds[a].upper.array() < bounds[b].lower.array()).any() ||
                               (bounds[a].lower.array() > bounds[b].upper.array()).any();
            if (a != b && !apart)
                refusals.attempt(body_key(model, a), [&] {
                    check_overlap_of(model, description, a, b, bounds[b], geometries, suspicions);
                });
        }
}

/// Bodies that begin within what they touch.
void check_surface(const BuiltModel& built, const CaseDescription& description, std::size_t c,
                   std::vector<std::string>& suspicions)
{
    const Model& model = built.model;
    const ContactAssignment& contact = built.contacts[c];
    if (!at_rigid_surface(contact))
        return;
    const RigidContactSurface surface(model, contact);
    if (!surface.present())
        return;
    std::size_t deepest = 0, behind = 0, all = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < model.size(); ++i) {
        Vector3 normal;
        if (!names(contact, model.state.points.body[i]))
            continue;
        ++all;
        const double distance = surface.distance(model.state.points.position[i], normal);
        behind += distance < 0.0 ? 1 : 0;
        if (distance < least) {
            least = distance;
            deepest = i;
        }
    }
    if (behind == 0)
        return;
    const std::string what = fmt::format(
        "{} of the {} points of body '{}' begin {} {}, the deepest {:.4g} m at {}", behind, all,
        model.body_of(deepest).name, contact.obstacle ? "inside obstacle" : "below the surface of",
        contact.obstacle ? "'" + model.state.obstacles[*contact.obstacle].name + "'" : fmt::format("contact {}", c),
        -least, place(model.state.points.position[deepest]));
    if (least < -model.state.spacing)
        throw refusal(description, fmt::format("contact.{}", c), what,
                      contact.obstacle ? "move the body or the obstacle"
                                       : "move the body or the surface, or turn its normal to the body's side");
    suspicions.push_back(suspicion(description, fmt::format("contact.{}", c), what));
}

void check_friction(const BuiltModel& built, const CaseDescription& description, std::size_t c,
                    std::vector<std::string>& suspicions)
{
    const double friction = built.contacts[c].law->friction();
    const std::string key = fmt::format("contact.{}.friction", c);
    const std::string what = fmt::format("a coefficient of friction of {:.4g} is that of a slope of {:.1f} degrees",
                                         friction, 57.29578 * std::atan(friction));
    if (!(friction <= absurd_friction))
        throw refusal(description, key, what, "no surface has that; most have 0.2 to 1");
    if (friction > high_friction)
        suspicions.push_back(suspicion(description, key, what + "; most surfaces have 0.2 to 1"));
}

/// A body that outruns its own waves comes apart in the first steps, with errors that name something else.
void check_speeds(const Model& model, const CaseDescription& description, std::vector<std::string>& suspicions)
{
    std::vector<double> fastest(model.state.bodies.size(), 0.0), density(model.state.bodies.size(), 0.0);
    for (std::size_t i = 0; i < model.size(); ++i) {
        const std::uint32_t body = model.state.points.body[i];
        fastest[body] = std::max(fastest[body], model.state.points.velocity[i].norm());
        density[body] = model.state.points.mass[i] / model.state.points.volume[i];
    }
    for (std::size_t b = 0; b < model.state.bodies.size(); ++b) {
        const Material& material = *model.state.bodies[b].material;
        const double wave = std::sqrt((material.bulk_modulus() + 4.0 / 3.0 * material.shear_modulus()) / density[b]);
        if (fastest[b] > wave)
            suspicions.push_back(suspicion(
                description, body_key(model, b) + ".velocity",
                fmt::format("body '{}' begins with up to {:.4g} m/s, faster than a wave runs in it, {:.4g} m/s",
                            model.state.bodies[b].name, fastest[b], wave)));
        for (const ObstacleDescription& obstacle : description.obstacles)
            if (obstacle.velocity.norm() > wave)
                suspicions.push_back(suspicion(
                    description, "obstacle." + obstacle.name + ".velocity",
                    fmt::format("obstacle '{}' moves at {:.4g} m/s, faster than a wave runs in body '{}', {:.4g} m/s",
                                obstacle.name, obstacle.velocity.norm(), model.state.bodies[b].name, wave)));
    }
}

/// Suction that would press a body to nothing: the strain that S_r s means is that stress over the bulk modulus.
void check_suction(const Model& model, const CaseDescription& description, std::vector<std::string>& suspicions)
{
    std::vector<double> largest(model.state.bodies.size(), 0.0);
    for (std::size_t i = 0; i < model.size(); ++i) {
        double& stress = largest[model.state.points.body[i]];
        stress = std::max(stress, pore_stress(model.state.points.suction(i), model.state.points.saturation[i]));
    }
    for (std::size_t b = 0; b < largest.size(); ++b) {
        const double modulus = model.state.bodies[b].material->bulk_modulus();
        if (largest[b] > modulus)
            suspicions.push_back(
                suspicion(description, body_key(model, b) + ".water",
                          fmt::format("suction presses body '{}' together with up to S_r s = {:.4g} Pa, "
                                      "more than its bulk modulus of {:.4g} Pa",
                                      model.state.bodies[b].name, largest[b], modulus)));
    }
}

/// Has anything been given that moves a point by the end of a stage?
bool something_acts(const CaseDescription& description, const StageDescription& stage)
{
    const auto moves = [](const BodyDescription& body) {
        return !body.velocity.isZero() || !body.angular_velocity.isZero() || !body.strain_rate.isZero() ||
               body.water.kind != WaterKind::dry || body.initial_stress.kind != InitialStressKind::zero;
    };
    return !description.gravity.isZero() || std::ranges::any_of(description.bodies, moves) ||
           std::ranges::any_of(description.obstacles, [](const auto& it) { return !it.velocity.isZero(); }) ||
           std::ranges::any_of(description.held_regions, [](const auto& it) { return !it.velocity.isZero(); }) ||
           std::any_of(description.stages.data(), &stage + 1, [](const auto& it) { return !it.water_changes.empty(); });
}

void check_stages(const CaseDescription& description, std::vector<std::string>& suspicions)
{
    for (std::size_t s = 0; s < description.stages.size(); ++s)
        if (!something_acts(description, description.stages[s]))
            suspicions.push_back(
                suspicion(description, fmt::format("stage.{}", s),
                          fmt::format("nothing happens in stage '{}': there is no gravity, no velocity and no water",
                                      description.stages[s].name)));
}

} // namespace

std::vector<std::string> check_model(const BuiltModel& built, const CaseDescription& description,
                                     Geometries& geometries)
{
    std::vector<std::string> suspicions;
    Refusals refusals(description);
    if (description.outputs.empty())
        suspicions.push_back(suspicion(description, "output",
                                       "there is no [[output]]: a run leaves its summary and its log, and neither "
                                       "snapshots nor a history of energies; to store them add\n"
                                       "  [[output]]\n  writer = \"hdf5\"\n  every = \"20 ms\""));
    const bool distinct = refusals.attempt("body", [&] {
        check_resolution(built.model, description);
        check_coincidence(built.model, description);
    });
    if (distinct)
        check_overlaps(built.model, description, geometries, refusals, suspicions);
    std::ranges::copy(check_meetings(built, description), std::back_inserter(suspicions));
    check_planes(built, description, geometries, refusals, suspicions);
    check_rigid_surfaces(built, description, refusals, suspicions);
    for (std::size_t c = 0; c < built.contacts.size(); ++c) {
        const std::string key = fmt::format("contact.{}", c);
        refusals.attempt(key, [&] { check_surface(built, description, c, suspicions); });
        refusals.attempt(key, [&] { check_friction(built, description, c, suspicions); });
    }
    refusals.attempt("gravity", [&] { check_gravity(built, description, suspicions); });
    check_values(built, description, refusals, suspicions);
    check_speeds(built.model, description, suspicions);
    check_suction(built.model, description, suspicions);
    check_stages(description, suspicions);
    refusals.raise();
    return suspicions;
}

} // namespace periporo
