// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The volume that points occupy, and how J follows it.
#include "operator/occupied_volume.hpp"
#include "support/specimens.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <omp.h>

using namespace specimens;

namespace {

constexpr double dx = 0.01;
constexpr double porosity = 0.3;

Eigen::Matrix3d scaled(double volume)
{
    return std::cbrt(volume) * Eigen::Matrix3d::Identity();
}

Eigen::Matrix3d sheared(double amount)
{
    Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
    f(0, 2) = amount;
    return f;
}

std::vector<Vector3> mapped(std::vector<Vector3> positions, const Eigen::Matrix3d& map)
{
    for (Vector3& x : positions)
        x = map * x;
    return positions;
}

std::unique_ptr<ForceState> default_force()
{
    return make_force_state("energy_conjugate", Influence::by_name("linear", 3.015 * dx));
}

/// A model with families and active bonds.
Model evaluated(const std::vector<Vector3>& positions, const ForceState& force)
{
    Model model = from_positions(positions, dx);
    model.state.bodies[0].porosity = porosity;
    find_first_families(model, force);
    force.evaluate(model, {StressUpdate::keep, MaterialResponse::full, 0.0});
    return model;
}

/// Moves the points and finds families anew.
void move_to(Model& model, const ForceState& force, const std::vector<Vector3>& positions)
{
    model.state.points.position = positions;
    refresh_families(model, force);
    force.evaluate(model, {StressUpdate::keep, MaterialResponse::full, 0.0});
}

/// Sums of ln of measured over true V/V0, by support.
struct Deviations {
    double sum = 0.0, largest = 0.0;
    int count = 0;

    void add(double deviation)
    {
        sum += deviation;
        largest = std::max(largest, std::abs(deviation));
        ++count;
    }
    double mean() const { return sum / count; }
};

/// A block of soil, 8 x 8 x 8 points, that is deformed affinely by small steps, so that its families change.
struct Course {
    std::vector<Vector3> start = lattice(8, 8, 8, dx);
    std::unique_ptr<ForceState> force = default_force();
    Model model = evaluated(start, *force);
    const OccupiedVolume occupied{dx, 3.015 * dx};

    double support(std::size_t point) const { return occupied.of_point(model, point).support; }
};

} // namespace

TEST_CASE("the occupied volume of a lattice that is turned, compressed, dilated or sheared is det F")
{
    const OccupiedVolume occupied(dx, 3.015 * dx);
    const auto force = default_force();
    for (const double angle : {0.0, 0.4, 1.1}) {
        const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vector3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
        for (const Eigen::Matrix3d& f : {scaled(1.0), scaled(0.9), scaled(1.1), sheared(0.4)}) {
            CAPTURE(angle);
            CAPTURE(f);
            const Model model = evaluated(mapped(lattice(8, 8, 8, dx), turn * f), *force);
            Deviations inside, outside;
            for (std::size_t i = 0; i < model.size(); ++i) {
                const OccupiedVolume::Measure measure = occupied.of_point(model, i);
                (measure.support > 0.97 ? inside : outside).add(std::log(measure.ratio / f.determinant()));
            }
            REQUIRE(inside.count > 60); // 4 x 4 x 4 points are 3 rows from every face
            // The sum over a lattice is its integral within 0.3 per cent. The rays may miss an end of the body behind
            // which up to 3 per cent of the support lie, and see others too late.
            CHECK(inside.largest < 0.03);
            CHECK(std::abs(inside.mean()) < 0.01);
            // The faces of a turned lattice have steps. A ray that ends a tenth of a spacing late there adds 0.04 to a
            // support of 0.65.
            CHECK(std::abs(outside.mean()) < 0.06);
        }
    }
}

TEST_CASE("a point alone occupies about its initial volume")
{
    const auto force = default_force();
    const Model model = evaluated({Vector3::Zero()}, *force);
    const OccupiedVolume::Measure measure = OccupiedVolume(dx, 3.015 * dx).of_point(model, 0);
    // Its own ball of 0.67 spacings holds 1.26 dx^3, and W falls within it.
    CHECK(measure.ratio > 0.9);
    CHECK(measure.ratio < 1.26);
}

TEST_CASE("J keeps its bits where no neighbour came or went, however wrong it is")
{
    Course course;
    Model& model = course.model;
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> value(0.8, 1.2);
    for (std::size_t i = 0; i < model.size(); ++i)
        model.state.points.volume[i] *= model.state.points.jacobian[i] = value(generator);
    const std::vector<double> jacobian = model.state.points.jacobian, volume = model.state.points.volume;
    // The horizon has room for a stretch of 0.5 per cent before a neighbour leaves, for 5 before one enters.
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3(0.3, 1.0, 0.2).normalized()).toRotationMatrix();
    for (const Eigen::Matrix3d& f : {Eigen::Matrix3d(turn), Eigen::Matrix3d(1.004 * turn), scaled(0.99)}) {
        move_to(model, *course.force, mapped(course.start, f));
        CHECK(model.state.points.jacobian == jacobian);
        CHECK(model.state.points.volume == volume);
    }
}

TEST_CASE("in affine deformation through many refreshes J stays at det F")
{
    for (const double last : {0.85, 1.2}) {
        CAPTURE(last);
        Course course;
        Model& model = course.model;
        double ratio = 1.0;
        std::size_t exchanges = 0;
        for (int step = 1; step <= 60; ++step) {
            const double next = std::pow(last, step / 60.0);
            for (double& j : model.state.points.jacobian) // as the exact gradient advances it
                j *= next / ratio;
            ratio = next;
            const std::size_t bonds = model.neighbourhood.families.bonds();
            move_to(model, *course.force, mapped(course.start, scaled(ratio) * sheared(0.005 * step)));
            exchanges += model.neighbourhood.families.bonds() != bonds ? 1 : 0;
        }
        REQUIRE(exchanges > 2);
        Deviations inside, outside;
        for (std::size_t i = 0; i < model.size(); ++i)
            (course.support(i) > 0.97 ? inside : outside).add(std::log(model.state.points.jacobian[i] / last));
        // The correction sees what lies beyond the uncertainty of the measure, and inside nothing does.
        CHECK(inside.largest < 0.015);
        CHECK(std::abs(outside.mean()) < 0.03);
    }
}

namespace {

/// Points of a block as they are mixed more and more: every step shifts each of them a little at random, about its
/// place on the lattice, and shears the block.
std::vector<Vector3> mixed(const std::vector<Vector3>& lattice_points, int step)
{
    return mapped(jittered(lattice_points, dx, 0.15, static_cast<unsigned>(step)), sheared(0.02 * step));
}

} // namespace

TEST_CASE("J of a cloud that is mixed comes back to the occupied volume")
{
    for (const double wrong : {0.88, 1.12}) {
        CAPTURE(wrong);
        Course course;
        Model& model = course.model;
        for (std::size_t i = 0; i < model.size(); ++i)
            model.state.points.volume[i] *= model.state.points.jacobian[i] = wrong;
        model.gather_ends();
        for (int step = 1; step <= 40; ++step)
            move_to(model, *course.force, mixed(course.start, step));
        Deviations inside;
        for (std::size_t i = 0; i < model.size(); ++i) {
            const double j = model.state.points.jacobian[i];
            CHECK(model.state.points.volume[i] == model.state.points.initial_volume[i] * volume_ratio(j, porosity));
            if (course.support(i) > 0.97)
                inside.add(std::log(j));
        }
        CHECK(inside.count > 60);
        // The block is as dense as at the start: shear keeps the volume, and so do shifts about places of the lattice.
        CHECK(std::abs(inside.mean()) < 0.02);
    }
}

TEST_CASE("the correction touches neither stress nor motion")
{
    Course with, without;
    const auto stress = [](std::size_t i, std::size_t b) {
        const double x = static_cast<double>((i * 31 + b * 7) % 17);
        return SymmetricTensor<double>{-1e3 - x, -2e3 + x, -3e3, 10.0 * x, 0.0, -x};
    };
    for (Model* model : {&with.model, &without.model}) {
        set_stress(*model, stress);
        set_velocity(*model, [](const Vector3& x) { return Vector3(x.z(), 0.1, -x.x()); });
    }
    // J is right in one and wrong in the other. The shares follow from the volumes before the refresh, so these agree.
    for (double& j : with.model.state.points.jacobian)
        j = 1.15;
    const std::vector<Vector3> velocity = with.model.state.points.velocity;
    for (Course* course : {&with, &without}) {
        course->model.state.points.position = mixed(course->start, 1);
        refresh_families(course->model, *course->force);
    }
    REQUIRE(with.model.state.points.volume != without.model.state.points.volume);
    CHECK(with.model.state.points.position == without.model.state.points.position);
    CHECK(with.model.state.points.velocity == velocity);
    CHECK(with.model.state.point_states.values == without.model.state.point_states.values);
    for (std::size_t i = 0; i < with.model.size(); ++i)
        for (std::size_t b = 0; b < with.model.neighbourhood.families[i].count; ++b)
            for (std::size_t c = 0; c < 6; ++c)
                REQUIRE(bond_value(with.model, i, b, c) == bond_value(without.model, i, b, c));
}

TEST_CASE("J has the same bits for any number of threads")
{
    const int threads = omp_get_max_threads();
    std::vector<double> first;
    for (const int count : {1, 2, 5}) {
        omp_set_num_threads(count);
        Course course;
        for (double& j : course.model.state.points.jacobian)
            j = 1.1;
        for (int step = 1; step <= 4; ++step)
            move_to(course.model, *course.force, mixed(course.start, step));
        if (first.empty())
            first = course.model.state.points.jacobian;
        CHECK(course.model.state.points.jacobian == first);
    }
    omp_set_num_threads(threads);
}

TEST_CASE("a point is never denser than its grains, and a gap is no soil")
{
    CHECK(volume_ratio(0.5, 0.3) == 0.7);
    CHECK(volume_ratio(0.9, 0.3) == 0.9);
    CHECK(volume_ratio(2.8, 0.3) == largest_volume_ratio);
    CHECK(volume_ratio(0.9, 0.0) == 0.9); // without pores the grains themselves are compressed
}
