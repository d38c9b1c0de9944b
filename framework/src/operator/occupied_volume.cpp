// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The kernel sum, the rays to the ends of the body, and the correction of J.
#include "operator/occupied_volume.hpp"

#include "operator/thread_buffers.hpp"
#include "operator/transpose.hpp"
#include "periporo/first_exception.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace periporo {
namespace {

/// Radius of the ball around a neighbour [spacings]: on the average over a face its balls end half a spacing beyond the
/// points.
constexpr double ball_radius = 0.67;
/// A ray that leaves the last ball here has met no end of the body: a family holds points up to the horizon only, and
/// a ray may miss the last balls before it [horizons].
constexpr double unbounded = 0.8;
/// Uncertainty of ln V/V0: inside the body, and what a support of 0 would add.
constexpr double uncertainty_inside = 0.01;
constexpr double uncertainty_of_support = 0.08;
/// Part of the deviation that is taken away for each part of the neighbours exchanged.
constexpr double rate = 8.0;

/// The 32 directions to the corners of a dodecahedron and an icosahedron, one of each opposite pair.
const std::array<Vector3, 16>& ray_axes()
{
    static const std::array<Vector3, 16> axes = [] {
        constexpr double g = std::numbers::phi;
        std::array<Vector3, 16> a;
        std::size_t at = 0;
        for (const double sign : {1.0, -1.0}) {
            for (const auto& [u, v] : {std::pair{1.0, g}, std::pair{1.0 / g, g}}) {
                a[at++] = {0.0, sign * u, v};
                a[at++] = {sign * u, v, 0.0};
                a[at++] = {v, 0.0, sign * u};
            }
            a[at++] = {sign, 1.0, 1.0};
            a[at++] = {1.0, sign, -sign};
        }
        for (Vector3& axis : a)
            axis.normalize();
        return a;
    }();
    return axes;
}

/// Where the body ends along a ray that leaves the last ball at `exit` [horizons]: there, or at 1 from `unbounded` on.
double end_of_body(double exit)
{
    const double s = exit / unbounded;
    return exit * (1.0 + (1.0 / unbounded - 1.0) * s * s * s * s);
}

/// Integral of W over the ball of a radius [horizons].
double weight_within(double radius)
{
    const double r = std::min(radius, 1.0);
    const double s = r * r;
    return 315.0 / 16.0 * r * s * (1.0 / 3.0 - s * (0.6 - s * (3.0 / 7.0 - s / 9.0)));
}

double largest_lane(const Pack& pack)
{
    double largest = pack[0];
    for (std::size_t lane = 1; lane < pack_width; ++lane)
        largest = std::max(largest, static_cast<double>(pack[lane]));
    return largest;
}

/// Relative positions of the neighbours of a point, pack by pack, and what follows from them. A thread keeps one.
class Surroundings {
public:
    void begin(double horizon, double ball_squared)
    {
        horizon_ = horizon;
        ball_squared_ = ball_squared;
        weights_ = 0.0;
        packs_ = 0;
    }

    /// @param zeta relative positions, zero in lanes without a neighbour
    /// @param volume V0, zero in lanes without a neighbour
    void add(const std::array<Pack, 3>& zeta, const Pack& volume)
    {
        const Pack squared = zeta[0] * zeta[0] + zeta[1] * zeta[1] + zeta[2] * zeta[2];
        const Pack inside = maximum(Pack(1.0) - squared * (1.0 / (horizon_ * horizon_)), Pack(0.0));
        weights_ += volume * inside * inside * inside;
        const std::size_t at = packs_++ * values * pack_width;
        if (rows_.size() < at + values * pack_width)
            rows_.resize(2 * (at + values * pack_width));
        std::size_t row = at;
        for (const Pack& value : {zeta[0], zeta[1], zeta[2], ball_squared_ - squared}) {
            store_pack(value, &rows_[row]);
            row += pack_width;
        }
    }

    /// sum V0 W/W(0) without the point itself.
    double weights() const { return reduce(weights_); }

    double support() const
    {
        double sum = 0.0;
        for (const Vector3& axis : ray_axes())
            for (const Pack& exit : exits(axis))
                sum += weight_within(end_of_body(largest_lane(exit) / horizon_));
        return sum / (2.0 * static_cast<double>(ray_axes().size()));
    }

private:
    /// Where the rays along an axis and against it leave the last ball, as the largest of all lanes.
    std::array<Pack, 2> exits(const Vector3& axis) const
    {
        const Pack own = std::sqrt(ball_squared_), x = axis.x(), y = axis.y(), z = axis.z(), none = 0.0;
        Pack forward = own, backward = own;
        const double* row = rows_.data();
        for (std::size_t p = 0; p < packs_; ++p, row += values * pack_width) {
            const Pack along =
                x * load_pack(row) + y * load_pack(row + pack_width) + z * load_pack(row + 2 * pack_width);
            const Pack squared = load_pack(row + 3 * pack_width) + along * along;
            const Pack half_chord = square_root(maximum(squared, none));
            const PackMask met = squared > none;
            forward = maximum(forward, select(met, half_chord + along, none));
            backward = maximum(backward, select(met, half_chord - along, none));
        }
        return {forward, backward};
    }

    static constexpr std::size_t values = 4; // zeta, and the squared radius of a ball minus |zeta|^2
    double horizon_ = 0.0;
    double ball_squared_ = 0.0;
    Pack weights_ = 0.0;
    std::size_t packs_ = 0;
    AlignedVector<double> rows_;
};

/// Neighbours that came or went, over those before and after.
double exchanged(const Families& before, const Families& after, std::size_t point)
{
    const FamilyView old_family = before[point];
    const FamilyView family = after[point];
    std::size_t kept = 0;
    for (std::size_t a = 0, b = 0; a < family.count && b < old_family.count;) { // both are ordered by key
        const std::uint64_t key = after.key(family.neighbours[a]);
        const std::uint64_t old_key = before.key(old_family.neighbours[b]);
        kept += key == old_key ? 1 : 0;
        a += key <= old_key ? 1 : 0;
        b += old_key <= key ? 1 : 0;
    }
    const std::size_t all = family.count + old_family.count;
    return all == 0 ? 0.0 : static_cast<double>(all - 2 * kept) / static_cast<double>(all);
}

} // namespace

OccupiedVolume::OccupiedVolume(double spacing, double horizon)
    : horizon_(horizon), ball_squared_(ball_radius * ball_radius * spacing * spacing),
      weight_at_centre_(315.0 / (64.0 * std::numbers::pi * horizon * horizon * horizon))
{
    const int reach = static_cast<int>(horizon / spacing) + 1;
    Surroundings lattice;
    lattice.begin(horizon, ball_squared_);
    for (int i = -reach; i <= reach; ++i)
        for (int j = -reach; j <= reach; ++j)
            for (int k = -reach; k <= reach; ++k) {
                const Vector3 zeta = spacing * Vector3(i, j, k);
                if ((i == 0 && j == 0 && k == 0) || zeta.norm() > horizon)
                    continue;
                Pack volume = 0.0;
                volume[0] = spacing * spacing * spacing;
                lattice.add({Pack(zeta.x()), Pack(zeta.y()), Pack(zeta.z())}, volume);
            }
    whole_ = lattice.support();
    lattice_ = weight_at_centre_ * (spacing * spacing * spacing + lattice.weights());
}

OccupiedVolume::Measure OccupiedVolume::of_point(const Model& model, std::size_t point) const
{
    const FamilyView family = model.neighbourhood.families[point];
    const BondEnd& self = model.ends[point];
    auto& around = thread_buffers<Surroundings>();
    around.begin(horizon_, ball_squared_);
    for (std::size_t p = 0; p < family.packs; ++p) {
        const std::uint32_t* neighbours = family.neighbours + p * pack_width;
        const std::array<Pack, 8> other =
            load_transposed<8>([&](std::size_t lane) { return model.ends[neighbours[lane]].position; });
        Pack volume = 0.0;
        for (std::size_t lane = 0; lane < family.bonds_in(p); ++lane)
            volume[lane] = model.neighbourhood.initial_volume[neighbours[lane]];
        around.add({other[0] - self.position[0], other[1] - self.position[1], other[2] - self.position[2]}, volume);
    }
    const double support = around.support() / whole_;
    const double filled = weight_at_centre_ * (model.state.points.initial_volume[point] + around.weights());
    return {support * lattice_ / filled, support};
}

void follow_occupied_volume(Model& model, const Families& before)
{
    Points& points = model.state.points;
    const OccupiedVolume occupied(model.state.spacing, model.state.horizon);
    const auto follow = [&](std::size_t i) {
        const double part = std::min(1.0, rate * exchanged(before, model.neighbourhood.families, i));
        if (part == 0.0)
            return;
        const OccupiedVolume::Measure measure = occupied.of_point(model, i);
        const double deviation = std::log(measure.ratio / points.jacobian[i]);
        const double uncertainty = uncertainty_inside + uncertainty_of_support * std::max(0.0, 1.0 - measure.support);
        const double beyond = deviation - std::clamp(deviation, -uncertainty, uncertainty);
        if (beyond == 0.0)
            return;
        points.jacobian[i] *= std::exp(part * beyond);
        points.volume[i] = points.initial_volume[i] * volume_ratio(points.jacobian[i], model.body_of(i).porosity);
    };
    FirstException failure;
#pragma omp parallel for schedule(dynamic, 64)
    for (std::size_t i = 0; i < model.size(); ++i)
        failure.guard(i, [&] { follow(i); });
    failure.rethrow();
    model.gather_ends();
}

} // namespace periporo
