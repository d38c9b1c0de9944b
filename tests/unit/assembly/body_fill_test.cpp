// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies filled with material points: by a lattice, by a shaken one, by a centroidal Voronoi tessellation.
#include "assembly/body_fill.hpp"

#include "assembly/body_samples.hpp"
#include "neighbourhood/cell_list.hpp"
#include "support/errors.hpp"

#include <doctest/doctest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace {

using namespace periporo;

/// Boxes that do not overlap.
class Blocks : public Geometry {
public:
    explicit Blocks(std::vector<Bounds> blocks) : blocks_(std::move(blocks)) {}
    bool contains(const Vector3& x) const override
    {
        return std::any_of(blocks_.begin(), blocks_.end(), [&](const Bounds& block) {
            return (x.array() >= block.lower.array()).all() && (x.array() <= block.upper.array()).all();
        });
    }
    Bounds bounds() const override
    {
        Bounds all = blocks_.front();
        for (const Bounds& block : blocks_)
            all = {all.lower.cwiseMin(block.lower), all.upper.cwiseMax(block.upper)};
        return all;
    }
    double volume() const override
    {
        return std::accumulate(blocks_.begin(), blocks_.end(), 0.0, [](double sum, const Bounds& block) {
            return sum + (block.upper - block.lower).prod();
        });
    }

private:
    std::vector<Bounds> blocks_;
};

class Ball : public Geometry {
public:
    explicit Ball(double radius) : radius_(radius) {}
    bool contains(const Vector3& x) const override { return x.squaredNorm() <= radius_ * radius_; }
    Bounds bounds() const override { return {Vector3::Constant(-radius_), Vector3::Constant(radius_)}; }
    double volume() const override { return 4.0 / 3.0 * std::numbers::pi * radius_ * radius_ * radius_; }

private:
    double radius_;
};

/// Fills itself with one point in the middle.
class OwnFill : public Blocks {
public:
    OwnFill() : Blocks({{Vector3::Zero(), Vector3::Ones()}}) {}
    PointCloud fill(double) const override { return {{Vector3::Constant(0.5)}, {1.0}}; }
};

// Spacing of 1 in all tests. Not all faces are where a lattice has its cells.
const Blocks cube({{Vector3::Zero(), Vector3::Constant(5.0)}});
const Ball ball(3.2);
const Blocks angle({{{0.2, 0.0, 0.0}, {6.0, 3.1, 4.0}}, {{0.2, 3.1, 0.0}, {3.0, 6.0, 4.0}}});
const std::vector<const Geometry*> bodies{&cube, &ball, &angle};

FillDescription jittered(double amplitude, std::int64_t seed = 1)
{
    return {.kind = FillKind::jittered, .amplitude = amplitude, .seed = seed};
}

FillDescription relaxed(std::int64_t iterations = 20)
{
    return {.kind = FillKind::relaxed, .iterations = iterations};
}

double sum(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

std::size_t nearest(const std::vector<Vector3>& points, const Vector3& x)
{
    return static_cast<std::size_t>(std::min_element(points.begin(), points.end(),
                                                     [&](const Vector3& a, const Vector3& b) {
                                                         return (a - x).squaredNorm() < (b - x).squaredNorm();
                                                     }) -
                                    points.begin());
}

/// Mean square distance of all places in the body from their nearest point, as the samples see it [m2].
double energy(const Geometry& geometry, const std::vector<Vector3>& points)
{
    const std::vector<Vector3> samples = BodySamples(geometry, 1.0).positions();
    double total = 0.0;
    for (const Vector3& sample : samples)
        total += (sample - points[nearest(points, sample)]).squaredNorm();
    return total / static_cast<double>(samples.size());
}

/// Standard deviation of the distance to the nearest other point over its mean.
double unevenness(const std::vector<Vector3>& points)
{
    const CellList list(points, 2.0);
    double first = 0.0;
    double second = 0.0;
    for (const Vector3& x : points) {
        double least = std::numeric_limits<double>::infinity();
        list.visit_near(x, [&](std::uint32_t other) {
            if (&points[other] != &x)
                least = std::min(least, (points[other] - x).squaredNorm());
        });
        first += std::sqrt(least);
        second += least;
    }
    const auto n = static_cast<double>(points.size());
    return std::sqrt(n * second / (first * first) - 1.0);
}

/// Mean of x^4 + y^4 + z^4 over the unit directions between neighbours: 1 on a cubic lattice, 3/5 without direction.
double cubic_order(const std::vector<Vector3>& points)
{
    const CellList list(points, 1.3);
    double total = 0.0;
    double count = 0.0;
    for (const Vector3& x : points)
        list.visit_near(x, [&](std::uint32_t other) {
            const Vector3 between = points[other] - x;
            if (&points[other] == &x || between.norm() > 1.3)
                return;
            total += between.normalized().array().pow(4).sum();
            count += 1.0;
        });
    return total / count;
}

} // namespace

TEST_CASE("a lattice is the geometry's own when aligned with the body, and a plain one when aligned with the axes")
{
    const OwnFill geometry;
    CHECK(fill_body(geometry, 0.25, {.align = LatticeAxes::body}).positions.size() == 1);
    CHECK(fill_body(geometry, 0.25, {.align = LatticeAxes::axes}).positions.size() == 64);
}

TEST_CASE("jittered and relaxed points are as many as the lattice has, inside, and share the body's exact volume")
{
    for (const Geometry* body : bodies)
        for (const FillDescription& fill : {jittered(0.4), relaxed()}) {
            CAPTURE(name_of(fill.kind));
            const PointCloud cloud = fill_body(*body, 1.0, fill);
            CHECK(cloud.positions.size() == fill_by_lattice(*body, 1.0).positions.size());
            REQUIRE(cloud.volumes.size() == cloud.positions.size());
            CHECK(std::all_of(cloud.positions.begin(), cloud.positions.end(),
                              [&](const Vector3& x) { return body->contains(x); }));
            CHECK(*std::min_element(cloud.volumes.begin(), cloud.volumes.end()) > 0.0);
            // A thousand sums, each rounded by 1e-16.
            CHECK(sum(cloud.volumes) == doctest::Approx(body->volume()).epsilon(1e-13).scale(0.0));
        }
}

TEST_CASE("jittered points are shifted evenly within the amplitude along each axis")
{
    constexpr double amplitude = 0.3; // reaches no face: the points are half a spacing away
    const Blocks large({{Vector3::Zero(), Vector3::Constant(10.0)}});
    const PointCloud lattice = fill_by_lattice(large, 1.0);
    const PointCloud shaken = fill_body(large, 1.0, jittered(amplitude));
    Vector3 sums = Vector3::Zero();
    double squares = 0.0;
    for (std::size_t p = 0; p < lattice.positions.size(); ++p) {
        const Vector3 shift = shaken.positions[p] - lattice.positions[p];
        CHECK(shift.lpNorm<Eigen::Infinity>() <= amplitude * (1.0 + 1e-14)); // rounding at 10 m
        sums += shift;
        squares += shift.squaredNorm();
    }
    // A shift u has the mean 0 and the mean square a^2/3, whose variances are a^2/3 and a^4/5 - a^4/9: five standard
    // errors of 1000 points and 3000 shifts.
    const double square = amplitude * amplitude;
    CHECK((sums / 1000.0).lpNorm<Eigen::Infinity>() < 5.0 * std::sqrt(square / 3.0 / 1000.0));
    const double error = square * std::sqrt(4.0 / 45.0 / 3000.0);
    CHECK(std::abs(squares / 3000.0 - square / 3.0) < 5.0 * error);
}

TEST_CASE("points near the surface stay inside although their shifts would carry them out")
{
    const Blocks cut({{Vector3::Zero(), {4.55, 5.0, 5.0}}}); // a twentieth beyond the last centres
    const PointCloud lattice = fill_by_lattice(cut, 1.0);
    const PointCloud shaken = fill_body(cut, 1.0, jittered(0.4));
    REQUIRE(lattice.positions.size() == 125);
    for (std::size_t p = 0; p < lattice.positions.size(); ++p) {
        const Vector3 shift = shaken.positions[p] - lattice.positions[p];
        CHECK(cut.contains(shaken.positions[p]));
        CHECK(shift.lpNorm<Eigen::Infinity>() <= 0.4 * (1.0 + 1e-14));
        CHECK(shift.norm() > 0.0);
    }
}

TEST_CASE("a fill follows from its seed alone, to the last bit, with any number of threads")
{
    const int before = omp_get_max_threads();
    for (FillDescription fill : {jittered(0.4), relaxed(5)}) {
        omp_set_num_threads(1);
        const PointCloud one = fill_body(ball, 1.0, fill);
        omp_set_num_threads(3);
        const PointCloud three = fill_body(ball, 1.0, fill);
        omp_set_num_threads(before);
        CHECK(one.positions == three.positions);
        CHECK(one.volumes == three.volumes);
        fill.seed = 2;
        CHECK(fill_body(ball, 1.0, fill).positions != one.positions);
    }
}

TEST_CASE("Voronoi cells hold the samples that a search of all points gives them, near and far")
{
    // The spike is thinner than half a spacing, so that no centre of a lattice cell lies in it, and eight long.
    const Blocks spiked({{Vector3::Zero(), Vector3::Constant(4.0)}, {{4.0, 2.6, 2.6}, {12.0, 2.9, 2.9}}});
    for (const Geometry* body : {static_cast<const Geometry*>(&spiked), static_cast<const Geometry*>(&ball)}) {
        const std::vector<Vector3> points = fill_body(*body, 1.0, jittered(0.45)).positions;
        const BodySamples samples(*body, 1.0);
        std::vector<std::int64_t> counts(points.size(), 0);
        std::vector<Vector3> sums(points.size(), Vector3::Zero());
        double farthest = 0.0;
        for (const Vector3& sample : samples.positions()) {
            CHECK(body->contains(sample));
            const std::size_t owner = nearest(points, sample);
            farthest = std::max(farthest, (points[owner] - sample).norm());
            ++counts[owner];
            sums[owner] += sample;
        }
        CHECK((farthest > 7.0) == (body == &spiked));
        const VoronoiCells cells = samples.cells(points);
        CHECK(cells.samples == counts);
        for (std::size_t p = 0; p < points.size(); ++p)
            CHECK((cells.centroids[p] - sums[p] / static_cast<double>(counts[p])).norm() < 1e-12); // sums of 1e3 terms
    }
}

TEST_CASE("the cells of an undisturbed lattice in a box of whole cells are equal to the last sample")
{
    const Blocks shifted({{Vector3(0.3, -7.1, 0.25), Vector3(5.3, -3.1, 3.25)}});
    std::vector<Vector3> centres;
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 5; ++i)
                centres.push_back(shifted.bounds().lower + Vector3(i + 0.5, j + 0.5, k + 0.5));
    for (const std::int64_t count : BodySamples(shifted, 1.0).cells(centres).samples)
        CHECK(count == 512);
}

TEST_CASE("every iteration of Lloyd's method brings the points nearer to what they stand for")
{
    // Neither step can raise the energy: each sample goes to its nearest point, each point towards the centroid of its
    // samples.
    for (const Geometry* body : bodies) {
        double last = energy(*body, fill_body(*body, 1.0, relaxed(0)).positions);
        for (std::int64_t iterations = 1; iterations <= 4; ++iterations) {
            const double next = energy(*body, fill_body(*body, 1.0, relaxed(iterations)).positions);
            CHECK(next < last);
            last = next;
        }
    }
}

TEST_CASE("relaxed cells are rounder than cubes, and not rounder than balls")
{
    // The mean square distance from the centre is a^2/4 in a cube of edge a, 3/5 r^2 in a ball: 0.2310 v^(2/3). No
    // points whatever do better than balls of equal volume. The samples know the energy to a part in a thousand.
    for (const Geometry* body : bodies) {
        const std::vector<Vector3> points = fill_body(*body, 1.0, relaxed()).positions;
        const double cell = body->volume() / static_cast<double>(points.size());
        const double scaled = energy(*body, points) / std::cbrt(cell * cell);
        CHECK(scaled > 0.2310 * 0.999);
        CHECK(scaled < 0.25);
    }
}

TEST_CASE("relaxed points are even and have forgotten the lattice, jittered ones neither")
{
    const Ball large(8.0);
    const std::vector<Vector3> shaken = fill_body(large, 1.0, jittered(0.2)).positions;
    const std::vector<Vector3> even = fill_body(large, 1.0, relaxed()).positions;
    CHECK(unevenness(even) < unevenness(shaken));
    // 2000 points with a dozen neighbours: without direction the mean strays from 3/5 by 0.002.
    CHECK(std::abs(cubic_order(even) - 0.6) < 0.02);
    CHECK(cubic_order(shaken) > 0.7);
}

TEST_CASE("relaxed points have the centroid of the body and its second moments, but for what lies within a cell")
{
    // The second moment of a body along an axis is that of its points and those of their cells about themselves. The
    // latter are between v^(2/3)/12.99 of the volume, in balls, and v^(2/3)/12, in cubes. So the points of a ball, of
    // second moment R^2/5, have between 5/12.99 and 5/12 of (dx/R)^2 less: 0.40, give or take 0.02.
    for (const double radius : {5.3, 8.1}) {
        const Ball body(radius);
        const PointCloud cloud = fill_body(body, 1.0, relaxed());
        Vector3 first = Vector3::Zero();
        Vector3 second = Vector3::Zero();
        for (std::size_t p = 0; p < cloud.positions.size(); ++p) {
            first += cloud.volumes[p] / body.volume() * cloud.positions[p];
            second += cloud.volumes[p] / body.volume() * cloud.positions[p].cwiseAbs2();
        }
        // No point is more than a few hundredths of a spacing from the centroid of its cell; over the root of 600
        // points that are so at random it is 2e-3.
        CHECK(first.norm() < 5e-3);
        for (const double moment : second)
            CHECK(std::abs((1.0 - 5.0 * moment / (radius * radius)) * radius * radius - 0.40) < 0.02);
    }
}

TEST_CASE("points do not leave a body whose cells have their centroids outside")
{
    // The lattice has points in the lower plate only, so that their cells reach across the gap.
    const Blocks plates({{{0.0, 0.0, 0.1}, {6.0, 6.0, 0.6}}, {{0.0, 0.0, 0.9}, {6.0, 6.0, 1.4}}});
    const std::vector<Vector3> points = fill_body(plates, 1.0, relaxed()).positions;
    const auto is_inside = [&](const Vector3& x) { return plates.contains(x); };
    CHECK(points.size() == 36);
    CHECK(std::all_of(points.begin(), points.end(), is_inside));
    const VoronoiCells cells = BodySamples(plates, 1.0).cells(points);
    CHECK_FALSE(std::all_of(cells.centroids.begin(), cells.centroids.end(), is_inside));
}

TEST_CASE("progress goes from nothing to all")
{
    std::vector<double> parts;
    fill_body(ball, 1.0, relaxed(4), [&](double part) { parts.push_back(part); });
    CHECK(parts == std::vector<double>{0.0, 0.25, 0.5, 0.75, 1.0});
}

TEST_CASE("points at rest are moved no more")
{
    std::size_t calls = 0;
    fill_body(Blocks({{Vector3::Zero(), Vector3::Constant(2.0)}}), 1.0, relaxed(1000), [&](double) { ++calls; });
    CHECK(calls < 200); // eight points soon stand in the middle of their octants
}

TEST_CASE("a fill that means nothing is an error that says what would")
{
    const auto message = [](const FillDescription& fill) {
        try {
            fill_body(cube, 1.0, fill);
        } catch (const std::invalid_argument& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    test::check_mentions(message(jittered(0.5)), {"below 0.5"});
    test::check_mentions(test::message_of_error([] { fill_body(cube, 0.0, relaxed()); }), {"spacing"});
}
