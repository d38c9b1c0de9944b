// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The step holds when a contact begins: blocks that fall, and grains that collide, at the default step.
#include "small_run.hpp"

#include <fmt/format.h>

using namespace periporo::test;

namespace {

std::string law_text(const std::string& law, double modulus, double restitution, double friction = 0.5)
{
    std::string text = fmt::format("law = '{}'\nfriction = {}\nrestitution = {}\n", law, friction, restitution);
    text += law == "hertz" ? fmt::format("young_modulus = '{} Pa'\npoisson_ratio = 0.3\n", modulus)
                           : fmt::format("modulus = '{} Pa'\n", modulus);
    if (law == "adhesive")
        text += "strength = '0.1 Pa'\n";
    if (law == "rigid_plane")
        text += "point = [0, 0, 0]\nnormal = [0, 0, 1]\n";
    return text;
}

std::string box(double edge, double height, double bottom) // [mm]
{
    return fmt::format("{{ generator = 'box', size = ['{0} mm', '{0} mm', '{1} mm'], "
                       "origin = ['{2} mm', '{2} mm', '{3} mm'] }}",
                       edge, height, -0.5 * edge, bottom);
}

/// What a block meets.
enum class Meets { plane, obstacle, moving_obstacle, points, smoothed };

struct Fall {
    const char* name;
    Meets meets;
    const char* law;
    double modulus; // [Pa]
    const char* force_state;
    double speed;     // at the start, of a fall of speed^2/(2 g) [m/s]
    double gap = 9.7; // beyond what counts at the start [mm]
    double restitution = 0.1;
    bool alone = false; // almost without gravity, without friction, and another body below is held
};

constexpr double block_mass = 0.6 * 2600.0 * 96e-6;
constexpr double almost_no_gravity = 1e-3; // [m/s2]: its energy tells the height of the centre of mass

/// Until the block has met what it falls on and left it [ms].
double duration(const Fall& fall)
{
    return 15.0 + (fall.speed > 0.0 ? fall.gap / fall.speed : std::sqrt(2e3 * fall.gap / 9.81));
}

/// 4 x 4 x 6 points of 10 mm above what they meet.
std::string fall_text(const Fall& fall)
{
    const bool comes_up = fall.meets == Meets::moving_obstacle;
    std::string text = "title = 'fall'\n";
    if (fall.alone)
        text += fmt::format("gravity = [0, 0, {}]\n", -almost_no_gravity);
    text += "[discretization]\nspacing = '10 mm'\n[material.a]\nmodel = 'linear_elastic'\n"
            "grain_density = '2600 kg/m3'\nporosity = 0.4\nbulk_modulus = '10 MPa'\nshear_modulus = '5 MPa'\n"
            "[run]\nhistory_every = '0.1 ms'\n[[output]]\nwriter = 'csv'\nevery = '1 s'\n"
            "[[stage]]\nname = 'go'\ntype = 'dynamic'\n";
    text += fmt::format("duration = '{} ms'\n", duration(fall));
    text += fmt::format("[operator]\nforce_state = '{}'\n", fall.force_state);
    text += fmt::format("[body.b]\nmaterial = 'a'\ngeometry = {}\nvelocity = [0, 0, '{} m/s']\n",
                        box(40.0, 60.0, fall.gap), comes_up ? 0.0 : -fall.speed);
    std::string between = "'b'";
    if (fall.meets == Meets::obstacle || comes_up) {
        text += fmt::format("[obstacle.o]\nvelocity = [0, 0, '{} m/s']\ngeometry = {}\n", comes_up ? fall.speed : 0.0,
                            box(1000.0, 1000.0, -1000.0));
        between = "'b', 'o'";
    } else if (fall.meets != Meets::plane) {
        text += fmt::format("[body.c]\nmaterial = 'a'\ngeometry = {}\n", box(40.0, 60.0, -60.0));
        between = "'b', 'c'";
    }
    text += fmt::format("[[contact]]\nbetween = [{}]\n{}", between,
                        law_text(fall.law, fall.modulus, fall.restitution, fall.alone ? 0.0 : 0.5));
    if (fall.meets == Meets::smoothed)
        text += "surface = 'c'\n";
    if (fall.alone && (fall.meets == Meets::smoothed || fall.meets == Meets::points))
        text += "[[boundary]]\ntype = 'fixed'\nbody = 'c'\n";
    return text;
}

/// One grain of 10 mm meets a plane or another grain at 1 m/s, without gravity. Returns its speed afterwards, relative
/// to the other.
double speed_after(const char* law, double modulus, double restitution, double ratio_of_masses, double gap)
{
    const bool pair = ratio_of_masses > 0.0;
    std::string text = "title = 'grain'\ngravity = [0, 0, 0]\n[discretization]\nspacing = '10 mm'\n"
                       "[[output]]\nwriter = 'csv'\nevery = '1 s'\n";
    const auto material = [&text](const char* name, double density) {
        text += fmt::format("[material.{}]\nmodel = 'linear_elastic'\ngrain_density = '{} kg/m3'\nporosity = 0.0\n"
                            "bulk_modulus = '4 MPa'\nshear_modulus = '2.4 MPa'\n",
                            name, density);
    };
    material("a", 2600.0);
    text += fmt::format("[body.a]\nmaterial = 'a'\ngeometry = {}\nvelocity = [0, 0, '-1 m/s']\n",
                        box(10.0, 10.0, gap + (pair ? 8.0 : 0.0)));
    if (pair) {
        material("b", 2600.0 * ratio_of_masses);
        text += fmt::format("[body.b]\nmaterial = 'b'\ngeometry = {}\n", box(10.0, 10.0, 0.0));
    }
    text +=
        fmt::format("[[contact]]\nbetween = [{}]\n{}", pair ? "'a', 'b'" : "'a'", law_text(law, modulus, restitution));
    text += "[[stage]]\nname = 'go'\ntype = 'dynamic'\nduration = '25 ms'\n";
    const SmallRun run = run_text(text);
    REQUIRE(run.failure.empty());
    const double mass = 2.6e-3, other = mass * ratio_of_masses;
    const double reduced = pair ? mass * other / (mass + other) : mass;
    const double common = pair ? 0.5 * mass * mass / (mass + other) : 0.0; // energy of the centre of mass [J]
    return std::sqrt(std::max(0.0, run.energy("kinetic") - common) / (0.5 * reduced));
}

} // namespace

TEST_CASE(
    "a block that falls on anything loses and gains no energy: the error is below 1 per cent of what was released")
{
    for (const Fall& fall : {
             Fall{"16 mm from rest on a plane", Meets::plane, "rigid_plane", 4e6, "energy_conjugate", 0.0, 16.0},
             Fall{"1 m on a soft plane", Meets::plane, "rigid_plane", 1e5, "energy_conjugate_mean", 4.4},
             Fall{"1 m on a plane", Meets::plane, "rigid_plane", 1e7, "bond_projection", 4.4},
             Fall{"1 mm on a hard plane", Meets::plane, "rigid_plane", 1e8, "bond_projection", 0.14},
             Fall{"0.1 m on a hard obstacle", Meets::obstacle, "penalty", 1e8, "bond_projection", 1.4},
             Fall{"0.1 m on an obstacle of spheres", Meets::obstacle, "hertz", 1e8, "bond_projection", 1.4},
             Fall{"an obstacle that comes at 1.4 m/s", Meets::moving_obstacle, "short_range", 1e8, "bond_projection",
                  1.4},
             Fall{"1 m on points", Meets::points, "penalty", 1e8, "bond_projection", 4.4},
             Fall{"16 mm on points that stick", Meets::points, "adhesive", 1e8, "bond_projection", 0.56},
             Fall{"16 mm on a smoothed surface", Meets::smoothed, "short_range", 1e6, "bond_projection", 0.56},
             Fall{"16 mm on a hard smoothed surface", Meets::smoothed, "penalty", 1e7, "energy_conjugate", 0.56},
             Fall{"0.1 m on a smoothed surface", Meets::smoothed, "short_range", 4e6, "bond_projection", 1.4},
             Fall{"1 m on a smoothed surface, with overlaps beyond the reach", Meets::smoothed, "hertz", 1e6,
                  "energy_conjugate", 4.4},
             Fall{"0.1 m on a smoothed surface that sticks", Meets::smoothed, "adhesive", 1e7, "energy_conjugate_mean",
                  1.4},
         }) {
        CAPTURE(std::string(fall.name));
        const SmallRun run = run_text(fall_text(fall));
        CHECK(run.failure == "");
        const double released = block_mass * (0.5 * fall.speed * fall.speed + 9.81e-3 * fall.gap);
        CHECK(run.largest("contact_energy") > 1e-3 * released); // or nothing was met
        CHECK(run.largest("energy_error") < 0.01 * released);
    }
}

TEST_CASE("a block, which rings, never leaves with more energy than it brought")
{
    for (const auto& [meets, law] : {std::pair{Meets::plane, "rigid_plane"}, std::pair{Meets::obstacle, "penalty"},
                                     std::pair{Meets::points, "penalty"}, std::pair{Meets::smoothed, "short_range"}})
        for (const double restitution : {0.0, 0.3, 1.0})
            for (const double modulus : {1e6, 2e7}) {
                CAPTURE(static_cast<int>(meets));
                CAPTURE(restitution);
                CAPTURE(modulus);
                const double speed = 1.4;
                const SmallRun run =
                    run_text(fall_text({"", meets, law, modulus, "bond_projection", speed, 9.7, restitution, true}));
                REQUIRE(run.failure.empty());
                const double brought = 0.5 * block_mass * speed * speed;
                CHECK(run.largest("contact_energy") > 1e-3 * brought); // or nothing was met
                const std::vector<double>&time = run.history.at("time"), &gravity = run.history.at("gravity_energy");
                const std::size_t last = time.size() - 1, before = last - 10; // a millisecond, free of contact
                CHECK(run.history.at("contact_energy")[before] == 0.0);
                const double leaves =
                    (gravity[last] - gravity[before]) / (time[last] - time[before]) / (block_mass * almost_no_gravity);
                CHECK(leaves > 0.0);
                CHECK(0.5 * block_mass * leaves * leaves <= 1.001 * brought); // gravity adds 2e-5
                // The motion with the ringing keeps all energy when e = 1, up to the error that a fall may have.
                CHECK(run.energy("kinetic") + run.energy("stress_work") <= 1.01 * brought);
                CHECK(run.largest("energy_error") < 0.01 * brought);
            }
}

TEST_CASE("a grain leaves a collision with the restitution of the law, on a plane and on grains of other masses")
{
    for (const double restitution : {0.0, 0.1, 0.5, 1.0})
        for (const double gap : {0.1, 0.127}) {
            CAPTURE(restitution);
            CAPTURE(gap);
            const double wanted = std::max(restitution, 0.048);
            CHECK(std::abs(speed_after("rigid_plane", 4e6, restitution, 0.0, gap) - wanted) < 0.02);
            CHECK(std::abs(speed_after("rigid_plane", 1e8, restitution, 0.0, gap) - wanted) < 0.02);
            CHECK(std::abs(speed_after("penalty", 1e7, restitution, 5.0, gap) - wanted) < 0.02);
            CHECK(std::abs(speed_after("hertz", 1e7, restitution, 1.0, gap) - wanted) < 0.02);
        }
}
