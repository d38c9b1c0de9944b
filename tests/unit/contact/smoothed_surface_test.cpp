// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The smoothed surface of a body of points, and what a grain on it feels.
#include "contact/contact_forces.hpp"
#include "contact/short_range/short_range.hpp"
#include "contact/smoothed_surface_contact.hpp"
#include "support/specimens.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <random>

using namespace specimens;

namespace {

constexpr double dx = 0.01;
constexpr int side = 18; // points of a substrate along x and y
constexpr int layers = 4;

/// A substrate whose upper face is z = 0, turned and shifted by `frame`, and one grain of another body.
struct Ground {
    explicit Ground(const Eigen::Isometry3d& frame = Eigen::Isometry3d::Identity(), double jitter = 0.0)
        : frame(frame), model(from_positions(positions(frame, jitter), dx))
    {
        model.state.bodies.push_back(model.state.bodies.front());
        model.state.points.body.back() = 1;
        find();
    }
    static std::vector<Vector3> positions(const Eigen::Isometry3d& frame, double jitter)
    {
        std::vector<Vector3> result = jittered(lattice(side, side, layers, dx), dx, jitter);
        for (Vector3& x : result)
            x = frame * (x - dx * Vector3(side / 2.0, side / 2.0, layers));
        result.push_back(frame * Vector3(0.0, 0.0, 10.0 * dx));
        return result;
    }
    void find()
    {
        find_first_families(model,
                            *make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon)));
        model.gather_ends();
    }
    /// Puts the grain to a place in the frame of the ground.
    void put(const Vector3& place)
    {
        model.state.points.position.back() = frame * place;
        model.gather_ends();
    }
    /// Puts a grain to each place, in the frame of the ground, instead of the one.
    void put_all(const std::vector<Vector3>& places)
    {
        Points& points = model.state.points;
        const std::size_t first = grain();
        points.resize(first + places.size());
        for (std::size_t g = 0; g < places.size(); ++g) {
            const std::size_t i = first + g;
            points.body[i] = 1;
            points.mass[i] = points.mass[first];
            points.volume[i] = points.initial_volume[i] = points.volume[first];
            points.position[i] = frame * places[g];
        }
        model.allocate();
        find();
    }
    std::uint32_t grain() const { return side * side * layers; } ///< the first, if there are more

    Eigen::Isometry3d frame;
    Model model;
};

std::shared_ptr<const Contact> law(double friction, double restitution)
{
    Parameters parameters;
    parameters.set("stiffness", 500.0);
    parameters.set("friction", friction);
    parameters.set("restitution", restitution);
    auto made = std::make_shared<ShortRange>(parameters);
    made->scale({dx, 3.015 * dx, ContactPartner::surface});
    return made;
}

ContactForces on_surface(double friction, double restitution = 1.0)
{
    return ContactForces({{law(friction, restitution), {1, 0}, {}, 0}});
}

std::vector<Vector3> reactions(ContactForces& contact, const Model& model, double step = 1e-5,
                               ContactForces::Approach approach = ContactForces::Approach::none)
{
    std::vector<Vector3> force(model.size(), Vector3::Zero());
    contact.add_reactions(model, step, approach, force);
    return force;
}

Eigen::Isometry3d some_frame()
{
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    frame.rotate(Eigen::AngleAxisd(0.7, Vector3(1.0, -2.0, 0.5).normalized()));
    frame.pretranslate(Vector3(0.3, -0.1, 0.2));
    return frame;
}

} // namespace

TEST_CASE("a lattice has a flat surface half a spacing outside its points, wherever it is turned")
{
    for (const Eigen::Isometry3d& frame : {Eigen::Isometry3d::Identity(), some_frame()}) {
        Ground ground(frame);
        SmoothedSurface surface;
        std::mt19937 generator(3);
        std::uniform_real_distribution<double> place(-2.0 * dx,
                                                     2.0 * dx); // a horizon from the edges: normals are exact
        for (int n = 0; n < 50; ++n) {
            const Vector3 at(place(generator), place(generator), 0.2 * place(generator));
            ground.put(at);
            surface.find(ground.model, 0, 1, 0.5 * dx, 0.1 * dx);
            REQUIRE(surface.near().size() == 1);
            Support support;
            REQUIRE(surface.find_support(ground.model, 0, support));
            CHECK((support.normal - frame.rotation() * Vector3::UnitZ()).norm() < 1e-12);
            CHECK(std::abs(support.distance - at.z()) < 1e-13);
        }
    }
}

TEST_CASE("the surface bears a grain above its last points, and not one a spacing beyond them")
{
    Ground ground;
    SmoothedSurface surface;
    const auto touches = [&](double x) {
        ground.put({x, 0.0, 0.0});
        surface.find(ground.model, 0, 1, 0.5 * dx, 0.1 * dx);
        Support support;
        return !surface.near().empty() && surface.find_support(ground.model, 0, support) && support.distance < 0.5 * dx;
    };
    CHECK(touches(0.5 * side * dx - 0.5 * dx));
    CHECK_FALSE(touches(0.5 * side * dx + 0.51 * dx)); // the side of the body reaches half a spacing
}

TEST_CASE("nothing leans on a rim that is almost straight with weights beyond all measure")
{
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> beside(-0.5, 1.5);
    std::uniform_real_distribution<double> along(-4.0, 4.0);
    std::uniform_real_distribution<double> above(-0.3, 0.5);
    int borne = 0;
    double largest = 0.0;
    for (const double jitter : {0.003, 0.01, 0.03}) {
        Ground ground(Eigen::Isometry3d::Identity(), jitter);
        SmoothedSurface surface;
        for (int n = 0; n < 400; ++n) {
            ground.put(dx * Vector3(0.5 * side + beside(generator), along(generator), above(generator)));
            surface.find(ground.model, 0, 1, 0.5 * dx, 0.1 * dx);
            Support support;
            if (surface.near().empty() || !surface.find_support(ground.model, 0, support))
                continue;
            ++borne;
            double weights = 0.0;
            for (const double weight : support.weights)
                weights += std::abs(weight);
            largest = std::max(largest, support.strength * weights);
        }
    }
    CHECK(borne >= 300);
    CHECK(largest < 3.0); // 2 at half a spacing beyond the last row of a lattice
}

namespace {

/// On an uneven ground of 18 x 18 points: inside, above the rim and a corner, and half a spacing beyond.
std::vector<Vector3> places_on_uneven_ground()
{
    return {{0.1, 0.2, 0.0}, {-1.3, 2.1, 0.3}, {4.0, 0.4, 0.1}, {8.5, 0.3, 0.1},
            {9.0, 1.2, 0.0}, {8.6, 8.4, 0.2},  {8.9, 8.8, -0.1}};
}

} // namespace

TEST_CASE("forces on an uneven surface and on its rim have no resultant and no moment")
{
    Ground ground(some_frame(), 0.2);
    ContactForces contact = on_surface(0.0);
    for (const Vector3& place : places_on_uneven_ground()) {
        ground.put(dx * place);
        contact.find_candidates(ground.model, 0.1 * dx);
        const std::vector<Vector3> force = reactions(contact, ground.model);
        Vector3 sum = Vector3::Zero(), moment = Vector3::Zero();
        double size = 0.0;
        for (std::size_t i = 0; i < force.size(); ++i) {
            sum += force[i];
            moment +=
                (ground.model.state.points.position[i] - ground.model.state.points.position.back()).cross(force[i]);
            size += force[i].norm();
        }
        CAPTURE(place.transpose());
        REQUIRE(size > 0.0);
        CHECK(sum.norm() < 1e-14 * size);
        CHECK(moment.norm() < 1e-13 * size * dx);
    }
}

TEST_CASE("the force on every point is minus the derivative of the stored energy, also where the surface ends")
{
    Ground ground(some_frame(), 0.2);
    ContactForces contact = on_surface(0.0);
    for (const Vector3& place : places_on_uneven_ground()) {
        CAPTURE(place.transpose());
        ground.put(dx * place);
        contact.find_candidates(ground.model, 0.1 * dx);
        const std::vector<Vector3> force = reactions(contact, ground.model);
        double largest = 0.0;
        for (const Vector3& f : force)
            largest = std::max(largest, f.norm());
        REQUIRE(largest > 0.0);
        SmoothedSurfaceContact alone({law(0.0, 1.0), {1, 0}, {}, 0}, 0);
        alone.find_candidates(ground.model, 0.1 * dx);
        std::vector<double> stored(ground.model.size(), 0.0); // as a refresh compares it
        alone.add_stored_energy(ground.model, stored);
        CHECK(stored[ground.grain()] == doctest::Approx(contact.energy()).epsilon(1e-12).scale(0.0));
        const double shift = 1e-5 * dx; // the third derivative of the energy is below 1e3 largest/dx^2: 1e-7
        for (std::size_t i = 0; i < force.size(); ++i) {
            if (force[i].isZero(0.0))
                continue;
            for (Eigen::Index c = 0; c < 3; ++c) {
                const auto energy_at = [&](double way) {
                    const Vector3 there = ground.model.state.points.position[i];
                    ground.model.state.points.position[i][c] += way;
                    ground.model.gather_ends();
                    reactions(contact, ground.model);
                    ground.model.state.points.position[i] = there;
                    return contact.energy();
                };
                const double slope = (energy_at(shift) - energy_at(-shift)) / (2.0 * shift);
                CHECK(std::abs(force[i][c] + slope) < 1e-6 * largest);
            }
        }
        ground.model.gather_ends();
    }
}

TEST_CASE("a grain slides over the points of a flat surface without feeling them")
{
    Ground ground;
    ContactForces contact = on_surface(0.0);
    contact.find_candidates(ground.model, 0.1 * dx);
    for (int n = 0; n < 20; ++n) {
        ground.put({0.1 * n * dx, 0.03 * n * dx, 0.2 * dx});
        contact.find_candidates(ground.model, 0.1 * dx);
        const Vector3 force = reactions(contact, ground.model)[ground.grain()];
        CHECK((force - Vector3(0.0, 0.0, 500.0 * 0.3 * dx)).norm() < 1e-12 * force.norm());
        CHECK(contact.energy() == doctest::Approx(0.5 * 500.0 * std::pow(0.3 * dx, 2)).epsilon(1e-12).scale(0.0));
    }
    CHECK(contact.deepest_overlap()[0] == doctest::Approx(0.6).epsilon(1e-12).scale(0.0));
}

TEST_CASE("a grain that loses its support in a refresh dissipates what it stored, one that gains support nothing")
{
    Ground ground;
    ContactForces contact = on_surface(0.0);
    const Vector3 pressed(0.1 * dx, 0.2 * dx, 0.2 * dx), free(0.1 * dx, 0.2 * dx, 5.0 * dx);
    const double stored = 0.5 * 500.0 * std::pow(0.3 * dx, 2);
    ground.put(pressed);
    contact.find_candidates(ground.model, 0.1 * dx);
    double dissipated = 1.0;
    CHECK(contact.begin_refresh(ground.model).empty());
    ground.put(free);
    contact.end_refresh(ground.model, 0.1 * dx, dissipated);
    CHECK(dissipated == doctest::Approx(1.0 + stored).epsilon(1e-12).scale(0.0));
    contact.begin_refresh(ground.model);
    ground.put(pressed);
    contact.end_refresh(ground.model, 0.1 * dx, dissipated);
    CHECK(dissipated == doctest::Approx(1.0 + stored).epsilon(1e-12).scale(0.0));
}

TEST_CASE("at a symmetry plane the half of a ground acts as the whole, dashpots included")
{
    Ground whole;
    // the grain and its mirror image stand on the whole ground
    const Vector3 place(0.3 * dx, 0.1 * dx, 0.2 * dx);
    whole.put_all({place, {-place.x(), place.y(), place.z()}});
    const Points& points = whole.model.state.points;
    const std::size_t last = points.size() - 1;
    const Vector3 sinking(0.0, 0.0, -0.02); // the dashpot depends on all grains that press on the surface
    whole.model.state.points.velocity[last - 1] = whole.model.state.points.velocity[last] = sinking;
    whole.model.gather_ends();
    ContactForces on_whole = on_surface(0.0, 0.3);
    on_whole.find_candidates(whole.model, 0.1 * dx);
    const std::vector<Vector3> expected = reactions(on_whole, whole.model, 1e-5, ContactForces::Approach::real);

    std::vector<Vector3> kept;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < last; ++i)
        if (points.position[i].x() > 0.0) {
            kept.push_back(points.position[i]);
            numbers.push_back(i);
        }
    Model half = from_positions(kept, dx);
    half.state.bodies.push_back(half.state.bodies.front());
    half.state.points.body.back() = 1;
    half.neighbourhood.isometries.set_generators({Isometry::reflection(0, 0.0)});
    find_first_families(half,
                        *make_force_state("energy_conjugate", Influence::by_name("constant", half.state.horizon)));
    half.state.points.velocity.back() = sinking;
    half.gather_ends();
    ContactForces on_half = on_surface(0.0, 0.3);
    on_half.find_candidates(half, 0.1 * dx);
    const std::vector<Vector3> found = reactions(on_half, half, 1e-5, ContactForces::Approach::real);
    const double size = found.back().norm();
    REQUIRE(size > 0.0);
    for (std::size_t i = 0; i < kept.size(); ++i)
        CHECK((found[i] - expected[numbers[i]]).norm() < 1e-13 * size);
}

TEST_CASE("friction stops a slow grain within a step, never throws it back, and is a pair of forces")
{
    Ground ground;
    ground.put({0.2 * dx, 0.3 * dx, 0.2 * dx});
    const double step = 1e-4;
    const double mass = ground.model.state.points.mass[ground.grain()];
    const double grip = 0.4 * 500.0 * 0.3 * dx; // mu F_n
    for (const double part : {0.1, 10.0}) {     // of the speed that friction stops in a step
        ground.model.state.points.velocity.back() = {part * grip * step / mass, 0.0, 0.0};
        ground.model.gather_ends();
        ContactForces contact = on_surface(0.4);
        contact.find_candidates(ground.model, 0.1 * dx);
        const std::vector<Vector3> force = reactions(contact, ground.model, step);
        const double friction = -force[ground.grain()].x();
        Vector3 sum = Vector3::Zero();
        Vector3 surface_change = Vector3::Zero(); // of the velocity of the surface under the grain
        SmoothedSurface surface;
        surface.find(ground.model, 0, 1, 0.5 * dx, 0.1 * dx);
        Support support;
        REQUIRE(surface.find_support(ground.model, 0, support));
        for (const Vector3& f : force)
            sum += f;
        for (std::size_t m = 0; m < support.ends.size(); ++m)
            surface_change += support.weights[m] * step / mass * force[support.ends[m]];
        CHECK(sum.norm() < 1e-14 * force[ground.grain()].norm());
        const double before = ground.model.state.points.velocity.back().x();
        const double after = before - step * friction / mass - surface_change.x();
        if (part < 1.0) {
            CHECK(after >= -1e-12 * before);
            CHECK(after < 0.9 * before);
        } else {
            CHECK(friction == doctest::Approx(grip).epsilon(1e-12).scale(0.0));
        }
    }
}

TEST_CASE("the bounds of points cover a crowd on the surface, and not by much")
{
    struct Crowd {
        double apart;  ///< grains from each other, in spacings
        double height; ///< of every second grain; the surface reaches 0.5
    };
    for (const auto& [apart, height] :
         {Crowd{4.0, 0.2}, {1.0, 0.2}, {0.6, 0.2}, {0.4, 0.2}, {1.0, 0.7}, {0.6, 0.7}, {0.4, 0.7}}) {
        CAPTURE(apart);
        CAPTURE(height);
        Ground ground(some_frame(), 0.1);
        std::vector<Vector3> places;
        for (double x = -1.5 * dx; x <= 2.5 * dx; x += apart * dx)
            for (double y = -1.5 * dx; y <= 2.5 * dx; y += apart * dx)
                places.emplace_back(x, y, (places.size() % 2 == 0 ? 0.2 : height) * dx);
        ground.put_all(places);
        ContactForces contact = on_surface(0.0, 0.1);
        contact.find_candidates(ground.model, 0.1 * dx);
        const std::vector<ContactBound>& bounds = contact.bounds(ground.model);

        // One column b = of the slopes of its distance, on the grain and on the surface, for every contact.
        SmoothedSurface surface;
        surface.find(ground.model, 0, 1, 0.5 * dx, 0.1 * dx);
        REQUIRE(surface.near().size() == places.size());
        const auto n = static_cast<Eigen::Index>(3 * ground.model.size());
        Eigen::MatrixXd contacts = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(places.size()));
        std::vector<std::uint32_t> grains;
        for (std::size_t s = 0; s < places.size(); ++s) {
            Support support;
            REQUIRE(surface.find_support(ground.model, s, support));
            if (support.distance >= 0.5 * dx)
                continue;
            const auto column = static_cast<Eigen::Index>(grains.size());
            grains.push_back(surface.near()[s]);
            contacts.block<3, 1>(3 * grains.back(), column) = support.own_slope;
            for (std::size_t m = 0; m < support.ends.size(); ++m)
                contacts.block<3, 1>(3 * support.ends[m], column) = support.slopes[m];
        }
        const auto count = static_cast<Eigen::Index>(grains.size());
        contacts.conservativeResize(Eigen::NoChange, count);

        // What each dashpot is in this crowd, from the force on its grain when all grains sink.
        const double speed = 1e-6;
        for (Eigen::Index s = 0; s < count; ++s)
            ground.model.state.points.velocity[grains[static_cast<std::size_t>(s)]] =
                -speed * contacts.block<3, 1>(3 * grains[static_cast<std::size_t>(s)], s);
        ground.model.gather_ends();
        std::vector<Vector3> force(ground.model.size(), Vector3::Zero());
        contact.add_reactions(ground.model, 1e-5, ContactForces::Approach::real, force);
        Eigen::VectorXd dashpots(count);
        for (Eigen::Index s = 0; s < count; ++s) {
            const std::uint32_t grain = grains[static_cast<std::size_t>(s)];
            const double slope = contacts.block<3, 1>(3 * grain, s).norm(); // of speed, of opening and of reaction
            dashpots[s] = contact.damping()[grain].norm() / (speed * slope * slope * slope);
        }
        REQUIRE(dashpots.minCoeff() > 0.0);

        // With K = sum k_s b_s b_s^T and blocks D, the largest eigenvalue of D^-1 K, sought as that of
        // sqrt(k_s k_t) b_s^T D^-1 b_t.
        const double mass = ground.model.state.points.mass[0];
        const auto largest = [](const Eigen::MatrixXd& matrix) {
            return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().maxCoeff();
        };
        const auto check = [&](Eigen::Matrix3d ContactBound::*kind, const Eigen::VectorXd& coefficients) {
            const Eigen::MatrixXd scaled = contacts * (coefficients / mass).cwiseSqrt().asDiagonal();
            Eigen::MatrixXd solved = scaled;
            double largest_bound = 0.0;
            for (Eigen::Index i = 0; i < n / 3; ++i) {
                const Eigen::Matrix3d& block = bounds[static_cast<std::size_t>(i)].*kind;
                largest_bound = std::max(largest_bound, block.norm());
                solved.middleRows<3>(3 * i) =
                    block.completeOrthogonalDecomposition().pseudoInverse() * scaled.middleRows<3>(3 * i);
            }
            CHECK(largest(scaled.transpose() * solved) <= 1.0 + 1e-9);
            return largest_bound / largest(scaled.transpose() * scaled);
        };
        const double above_stiffness = check(&ContactBound::stiffness, Eigen::VectorXd::Constant(count, 500.0));
        const double above_damping = check(&ContactBound::damping, dashpots);
        if (height < 0.5) { // all grains touch
            CHECK(above_stiffness <= 2.5);
            CHECK(above_damping <= 5.5); // a dashpot in a crowd is weaker than one alone, by up to 2 here
        }
    }
}
