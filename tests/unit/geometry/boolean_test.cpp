// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "boolean": sets, their surfaces, volumes and distances.
#include "support/errors.hpp"
#include "support/plugins.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <thread>

namespace {

using namespace periporo;
using List = std::vector<double>;
using Part = std::shared_ptr<const Geometry>;

constexpr double pi = std::numbers::pi;

Part box(const List& size, const List& origin = {0.0, 0.0, 0.0})
{
    return test::geometry("box", {{"size", size}, {"origin", origin}});
}

Part ball(double radius, const List& centre = {0.0, 0.0, 0.0})
{
    return test::geometry("sphere", {{"radius", radius}, {"centre", centre}});
}

Part cylinder(double radius, double height, const List& origin = {0.0, 0.0, 0.0})
{
    return test::geometry("cylinder", {{"radius", radius}, {"height", height}, {"origin", origin}});
}

Part boolean(const std::string& operation, const std::vector<Part>& operands)
{
    std::vector<std::string> names;
    for (std::size_t n = 0; n < operands.size(); ++n)
        names.push_back("part" + std::to_string(n));
    std::shared_ptr<Geometry> made = test::geometry("boolean", {{"operation", operation}, {"of", names}});
    made->set_operands(operands);
    return made;
}

/// Another geometry that keeps the distance from its surface to itself.
class Distanceless : public Geometry {
public:
    explicit Distanceless(Part part) : part_(std::move(part)) {}
    bool contains(const Vector3& x) const override { return part_->contains(x); }
    Bounds bounds() const override { return part_->bounds(); }
    double volume() const override { return part_->volume(); }

private:
    Part part_;
};

Part distanceless(const Part& part)
{
    return std::make_shared<Distanceless>(part);
}

/// Evenly in a cube about the origin.
std::vector<Vector3> random_points(std::size_t count, double half_width)
{
    std::mt19937_64 generator(5);
    std::uniform_real_distribution<double> coordinate(-half_width, half_width);
    std::vector<Vector3> points(count);
    for (Vector3& x : points)
        x = {coordinate(generator), coordinate(generator), coordinate(generator)};
    return points;
}

/// The error that the remark states, as a part of the volume.
double stated_error(const Geometry& geometry)
{
    const std::vector<std::string> remarks = geometry.remarks();
    REQUIRE(remarks.size() == 1);
    const std::string before = "volume by counting, +- ";
    REQUIRE(remarks.front().starts_with(before));
    REQUIRE(remarks.front().ends_with(" per cent"));
    return std::stod(remarks.front().substr(before.size())) / 100.0;
}

void check_counted_volume(const Geometry& geometry, double exact)
{
    const double error = stated_error(geometry);
    CHECK(error < 1.01e-4);
    CHECK(std::abs(geometry.volume() / exact - 1.0) < error);
}

/// Of the balls' radii a and b, their centres d apart.
double lens(double a, double b, double d)
{
    const double sum = a + b;
    const double difference = a - b;
    return pi * (sum - d) * (sum - d) * (d * d + 2.0 * d * sum - 3.0 * difference * difference) / (12.0 * d);
}

/// Two balls whose surfaces meet in a circle, and the distance from the surface of what is made of them.
struct TwoBalls {
    static constexpr double a = 1.0;
    static constexpr double b = 0.8;
    static constexpr double between = 1.1; ///< centres, along x

    Part first = ball(a);
    Part second = ball(b, {between, 0.0, 0.0});

    /// From the nearest place on the first or second sphere that is a surface of the result, or the circle.
    double surface_distance(const std::string& operation, const Vector3& x) const
    {
        const double circle_x = (between * between + a * a - b * b) / (2.0 * between);
        const double circle_radius = std::sqrt(a * a - circle_x * circle_x);
        double least = std::hypot(x.x() - circle_x, std::hypot(x.y(), x.z()) - circle_radius);
        for (const bool is_first : {true, false}) {
            const Vector3 centre(is_first ? 0.0 : between, 0.0, 0.0);
            const double radius = is_first ? a : b;
            const Vector3 foot = centre + radius * (x - centre).normalized();
            const bool foot_in_other = (is_first ? second : first)->contains(foot);
            // Which part of the sphere is left.
            const bool visible = operation == "union"          ? !foot_in_other
                                 : operation == "intersection" ? foot_in_other
                                                               : foot_in_other != is_first;
            if (visible)
                least = std::min(least, (x - foot).norm());
        }
        return least;
    }
};

const std::vector<std::string> operations{"union", "difference", "intersection"};

} // namespace

TEST_CASE("a position is contained as the operands say")
{
    const std::vector<Part> parts{ball(1.0), box({1.5, 1.5, 1.5}, {-0.2, -0.3, -0.4}),
                                  cylinder(0.4, 3.0, {0.1, 0.1, -1.5})};
    const Part all = boolean("union", parts);
    const Part rest = boolean("difference", parts);
    const Part common = boolean("intersection", parts);
    for (const Vector3& x : random_points(20000, 1.6)) {
        const bool in[] = {parts[0]->contains(x), parts[1]->contains(x), parts[2]->contains(x)};
        CHECK(all->contains(x) == (in[0] || in[1] || in[2]));
        CHECK(rest->contains(x) == (in[0] && !in[1] && !in[2]));
        CHECK(common->contains(x) == (in[0] && in[1] && in[2]));
    }
    CHECK_FALSE(all->contains(Vector3::Constant(std::numeric_limits<double>::quiet_NaN())));
    CHECK_FALSE(rest->contains(Vector3::Constant(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("the surface of what is taken away stays, unless the operand does not know where it is")
{
    const Part block = box({2.0, 2.0, 2.0}, {-1.0, -1.0, -1.0});
    const Vector3 wall(0.6, 0.0, 0.0);
    for (const Part& hole : {ball(0.6), box({1.2, 1.2, 1.2}, {-0.6, -0.6, -0.6})}) {
        const Part left = boolean("difference", {block, hole});
        CHECK(left->contains(wall));
        CHECK_FALSE(left->contains((1.0 - 1e-9) * wall));
        CHECK_FALSE(boolean("difference", {block, distanceless(hole)})->contains(wall));
    }
}

TEST_CASE("faces in one plane leave no sheet behind")
{
    // A tube and its bore end at the same planes.
    const Part tube = boolean("difference", {cylinder(1.0, 2.0), cylinder(0.5, 2.0)});
    for (const double z : {0.0, 1.0, 2.0}) {
        CHECK_FALSE(tube->contains(Vector3(0.2, 0.1, z)));
        CHECK(tube->contains(Vector3(0.6, 0.3, z)));
    }
    // Two boxes next to each other are taken away, one by one or as one.
    const Part block = box({4.0, 1.0, 1.0});
    const Part left = box({1.0, 0.5, 0.5}, {1.0, 0.25, 0.25});
    const Part right = box({1.0, 0.5, 0.5}, {2.0, 0.25, 0.25});
    const Vector3 between(2.0, 0.5, 0.5);
    CHECK_FALSE(boolean("difference", {block, left, right})->contains(between));
    CHECK_FALSE(boolean("difference", {block, boolean("union", {left, right})})->contains(between));
    CHECK(boolean("union", {left, right})->contains(between));
}

TEST_CASE("an edge between two cuts stays, as their surfaces do")
{
    const Part left = boolean("difference", {box({4.0, 4.0, 1.0}), box({1.0, 4.0, 1.0}), box({4.0, 1.0, 1.0})});
    CHECK(left->contains(Vector3(1.0, 1.0, 0.5)));
    CHECK(left->contains(Vector3(1.0, 2.0, 0.5)));
    CHECK_FALSE(left->contains(Vector3(1.0, 0.5, 0.5)));
}

TEST_CASE("what only touches a body takes nothing away")
{
    const Part left = boolean("difference", {box({1.0, 1.0, 1.0}), box({1.0, 1.0, 1.0}, {1.0, 0.0, 0.0})});
    CHECK(left->contains(Vector3(1.0, 0.5, 0.5)));
    CHECK(left->volume() == 1.0);
    CHECK(left->remarks().empty());
}

TEST_CASE("bounds hold all of a union, what is common to an intersection, and the first of a difference")
{
    const std::vector<Part> parts{box({1.0, 2.0, 3.0}), box({1.0, 2.0, 3.0}, {0.5, -1.0, 1.0})};
    const Bounds all = boolean("union", parts)->bounds();
    CHECK(all.lower == Vector3(0.0, -1.0, 0.0));
    CHECK(all.upper == Vector3(1.5, 2.0, 4.0));
    const Bounds common = boolean("intersection", parts)->bounds();
    CHECK(common.lower == Vector3(0.5, 0.0, 1.0));
    CHECK(common.upper == Vector3(1.0, 1.0, 3.0));
    const Bounds rest = boolean("difference", parts)->bounds();
    CHECK(rest.lower == parts[0]->bounds().lower);
    CHECK(rest.upper == parts[0]->bounds().upper);
}

TEST_CASE("parts that do not meet have the sum of their volumes, or all of the first, exactly and without remark")
{
    const std::vector<Part> parts{ball(1.0), box({1.0, 2.0, 0.5}, {1.0, 0.0, 0.0}),
                                  cylinder(0.5, 2.0, {0.0, 0.0, 5.0})};
    const Part all = boolean("union", parts);
    CHECK(all->volume() == parts[0]->volume() + parts[1]->volume() + parts[2]->volume());
    CHECK(all->remarks().empty());
    const Part rest = boolean("difference", parts);
    CHECK(rest->volume() == parts[0]->volume());
    CHECK(rest->remarks().empty());
}

TEST_CASE("counted volumes are those of closed forms within the error that is stated")
{
    SUBCASE("a box less a box, wherever the faces are")
    {
        std::mt19937_64 generator(11);
        std::uniform_real_distribution<double> corner(0.05, 0.35);
        for (int n = 0; n < 8; ++n) {
            const List size{0.3 + corner(generator), 0.3 + corner(generator), 0.3 + corner(generator)};
            const Part hole = box(size, {corner(generator), corner(generator), corner(generator)});
            check_counted_volume(*boolean("difference", {box({1.0, 1.1, 1.2}), hole}),
                                 1.32 - size[0] * size[1] * size[2]);
        }
    }
    SUBCASE("a tube")
    {
        check_counted_volume(*boolean("difference", {cylinder(0.05, 0.2), cylinder(0.04, 0.2)}),
                             pi * (0.05 * 0.05 - 0.04 * 0.04) * 0.2);
    }
    SUBCASE("balls that overlap")
    {
        const std::vector<Part> balls{ball(1.0), ball(0.8, {1.1, 0.0, 0.0})};
        const double common = lens(1.0, 0.8, 1.1);
        const double first = balls[0]->volume();
        check_counted_volume(*boolean("union", balls), first + balls[1]->volume() - common);
        check_counted_volume(*boolean("difference", balls), first - common);
        check_counted_volume(*boolean("intersection", balls), common);
        // Two that overlap beside a body that neither of them meets.
        const Part block = box({1.0, 1.0, 1.0}, {0.0, 0.0, 2.0});
        check_counted_volume(*boolean("union", {block, balls[0], balls[1]}), 1.0 + first + balls[1]->volume() - common);
        const Part whole = boolean("difference", {block, balls[0], balls[1]});
        CHECK(whole->volume() == 1.0);
        CHECK(whole->remarks().empty());
    }
    SUBCASE("a cut far thinner than any cell")
    {
        const Part block = box({1.0, 1.0, 1.0});
        const Part slot = box({0.001, 2.0, 2.0}, {0.3, -0.5, -0.5});
        check_counted_volume(*boolean("difference", {block, slot}), 0.999);
        check_counted_volume(*boolean("intersection", {block, slot}), 0.001);
    }
    SUBCASE("without a distance")
    {
        check_counted_volume(*boolean("difference", {box({1.0, 1.0, 1.0}), distanceless(ball(0.4, {0.5, 0.5, 0.5}))}),
                             1.0 - 4.0 / 3.0 * pi * 0.064);
    }
}

TEST_CASE("a shell that no formula and no distance shows is counted with the error that this takes")
{
    const double inner = 0.99;
    const Part shell = boolean("difference", {distanceless(ball(1.0)), distanceless(ball(inner))});
    const double exact = 4.0 / 3.0 * pi * (1.0 - inner * inner * inner);
    const double error = stated_error(*shell);
    CHECK(error < 0.01);
    CHECK(std::abs(shell->volume() / exact - 1.0) < error);
}

TEST_CASE("the volume is the same whichever thread asks first")
{
    const auto make = [] { return boolean("union", {ball(1.0), box({1.0, 1.0, 1.0})}); };
    const double expected = make()->volume();
    const Part asked = make();
    std::vector<double> found(4);
    {
        std::vector<std::jthread> threads;
        for (double& volume : found)
            threads.emplace_back([&volume, &asked] { volume = asked->volume(); });
    }
    CHECK(std::all_of(found.begin(), found.end(), [&](double volume) { return volume == expected; }));
}

TEST_CASE("the sign of the distance says what is contained, its size is no larger than the distance")
{
    const TwoBalls balls;
    for (const std::string& operation : operations) {
        CAPTURE(operation);
        const Part made = boolean(operation, {balls.first, balls.second});
        REQUIRE(made->has_distance());
        std::size_t inside = 0;
        for (const Vector3& x : random_points(20000, 1.9)) {
            Vector3 normal;
            const double distance = made->signed_distance(x, normal);
            const double exact = balls.surface_distance(operation, x);
            CHECK((distance <= 0.0) == made->contains(x)); // no random point is on the surface
            CHECK(normal.norm() == doctest::Approx(1.0).epsilon(1e-14));
            CHECK(std::abs(distance) < exact + 1e-14); // rounding
            const bool must_be_exact = operation == "union" ? distance > 0.0 : distance < 0.0;
            if (must_be_exact)
                CHECK(std::abs(std::abs(distance) - exact) < 1e-14);
            inside += distance < 0.0 ? 1 : 0;
        }
        CHECK(inside > 100);
    }
}

TEST_CASE("the normal is the direction in which the distance grows")
{
    const TwoBalls balls;
    const double step = 1e-6;
    for (const std::string& operation : operations) {
        const Part made = boolean(operation, {balls.first, balls.second});
        std::size_t smooth = 0;
        const std::vector<Vector3> points = random_points(1000, 1.5);
        for (const Vector3& x : points) {
            Vector3 normal;
            Vector3 other;
            made->signed_distance(x, normal);
            const double ahead = made->signed_distance(x + step * normal, other);
            const double behind = made->signed_distance(x - step * normal, other);
            // Central differences of a distance of curvature 1/r: an error of step^2/r^2, and rounding of 1e-16/step.
            smooth += std::abs((ahead - behind) / (2.0 * step) - 1.0) < 1e-9 ? 1 : 0;
        }
        // All but those within a step of where the two distances are equal.
        CHECK(smooth + 2 >= points.size());
    }
}

TEST_CASE("without the distance from one operand there is none")
{
    const Part made = boolean("union", {ball(1.0), distanceless(ball(0.5))});
    CHECK_FALSE(made->has_distance());
}

TEST_CASE("a boolean of a boolean is what its operands make it")
{
    const Part block = box({2.0, 2.0, 2.0}, {-1.0, -1.0, -1.0});
    const std::vector<Part> balls{ball(0.5, {-0.2, 0.0, 0.1}), ball(0.6, {0.3, 0.2, 0.0})};
    const Part at_once = boolean("difference", {block, balls[0], balls[1]});
    const Part nested = boolean("difference", {block, boolean("union", balls)});
    for (const Vector3& x : random_points(5000, 1.1)) {
        Vector3 first;
        Vector3 second;
        CHECK(nested->contains(x) == at_once->contains(x));
        CHECK(std::abs(nested->signed_distance(x, first) - at_once->signed_distance(x, second)) < 1e-14); // rounding
        CHECK((first - second).norm() < 1e-14);
    }
    check_counted_volume(*nested, 8.0 - balls[0]->volume() - balls[1]->volume() +
                                      lens(0.5, 0.6, Vector3(0.5, 0.2, -0.1).norm()));
}

TEST_CASE("a tube is filled with points that share its volume")
{
    const Part tube = boolean("difference", {cylinder(1.0, 2.0), cylinder(0.5, 2.0)});
    const PointCloud cloud = tube->fill(0.1);
    CHECK(std::all_of(cloud.positions.begin(), cloud.positions.end(),
                      [&](const Vector3& x) { return std::hypot(x.x(), x.y()) >= 0.5 && tube->contains(x); }));
    CHECK(std::accumulate(cloud.volumes.begin(), cloud.volumes.end(), 0.0) ==
          doctest::Approx(tube->volume()).epsilon(1e-12).scale(0.0)); // 5000 sums
}

TEST_CASE("fewer than two operands are an error that says how many there must be")
{
    for (const std::vector<std::string>& names : {std::vector<std::string>{}, {"alone"}})
        test::check_mentions(test::message_of_error([&] {
                                 test::geometry("boolean", {{"operation", std::string("union")}, {"of", names}});
                             }),
                             {"of must name two", "union", names.empty() ? "none" : "\"alone\""});
}

TEST_CASE("an empty result is an error that names the operation and the operands")
{
    test::check_mentions(test::message_of_error([] {
                             boolean("intersection", {ball(1.0), ball(1.0, {3.0, 0.0, 0.0})});
                         }),
                         {"intersection", "part0, part1", "empty"});
    // The balls' boxes overlap, the balls do not.
    const Part apart = boolean("intersection", {ball(1.0), ball(1.0, {1.9, 1.9, 1.9})});
    test::check_mentions(test::message_of_error([&] { apart->volume(); }), {"intersection", "part0, part1", "empty"});
    const Part gone = boolean("difference", {box({1.0, 1.0, 1.0}), ball(2.0)});
    test::check_mentions(test::message_of_error([&] { gone->volume(); }), {"difference", "part0, part1", "empty"});
    test::check_mentions(test::message_of_error([&] { gone->fill(0.1); }), {"difference", "part0, part1", "empty"});
}
