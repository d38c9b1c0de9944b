// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Searches the end of the elastic domain along rays of the triaxial plane.
#include "drive/yield_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

namespace periporo {
namespace {

constexpr double long_time = 1e6; // [s]
constexpr int directions = 181;   // from +p over +q to -p

SymmetricTensor<double> stress_of(const TriaxialStress& stress)
{
    const double lateral = stress.q / 3.0 - stress.p;
    return {lateral, lateral, lateral - stress.q, 0.0, 0.0, 0.0};
}

class DomainSearch {
public:
    DomainSearch(const MaterialPoint& point, double scale)
        : point_(point), bulk_modulus_(point.material().bulk_modulus()),
          shear_modulus_(point.material().shear_modulus()), scale_(scale)
    {
    }

    /// A stress of the p axis around which the law is elastic, sought from the scale downwards, then in tension; moved
    /// to the middle of the domain where the axis leaves it on both sides.
    std::optional<TriaxialStress> middle() const
    {
        if (!(bulk_modulus_ > 0.0) || !(shear_modulus_ > 0.0) || !(scale_ > 0.0))
            return std::nullopt;
        for (const double sign : {1.0, -1.0})
            for (double p = scale_; p > 1e-6 * scale_; p *= 0.8)
                if (surrounds({sign * p, 0.0})) {
                    const std::optional<double> up = distance({sign * p, 0.0}, {1.0, 0.0});
                    const std::optional<double> down = distance({sign * p, 0.0}, {-1.0, 0.0});
                    return TriaxialStress{sign * p + (up && down ? 0.5 * (*up - *down) : 0.0), 0.0};
                }
        return std::nullopt;
    }

    /// How far it is to the end of the domain [Pa]; nothing when it is farther than all that matters.
    std::optional<double> distance(const TriaxialStress& from, const TriaxialStress& direction) const
    {
        const auto on_ray = [&](double r) {
            return TriaxialStress{from.p + r * direction.p, from.q + r * direction.q};
        };
        double inside = 0.0;
        double outside = 1e-4 * scale_;
        while (is_elastic(from, on_ray(outside))) {
            inside = outside;
            outside *= 2.0;
            if (outside > 1e3 * scale_)
                return std::nullopt;
        }
        while (outside - inside > 1e-9 * std::max(outside, scale_)) {
            const double half = std::midpoint(inside, outside);
            (is_elastic(from, on_ray(half)) ? inside : outside) = half;
        }
        return inside;
    }

private:
    /// Whether the law goes from one stress to the other as Hooke's law would.
    bool is_elastic(const TriaxialStress& from, const TriaxialStress& to) const
    {
        MaterialPoint probe = point_;
        const SymmetricTensor<double> start = stress_of(from);
        const SymmetricTensor<double> change = stress_of(to) - start;
        probe.set_stress(start);
        const double volume_change = trace(change) / (3.0 * bulk_modulus_);
        const SymmetricTensor<double> strain =
            deviator(change) * (0.5 / shear_modulus_) + SymmetricTensor<double>::isotropic(volume_change / 3.0);
        if (!probe.step(strain, long_time).converged)
            return false;
        const SymmetricTensor<double> wanted = stress_of(to);
        return norm(probe.stress() - wanted) <= 1e-9 * (norm(wanted) + norm(change));
    }

    bool surrounds(const TriaxialStress& centre) const
    {
        const double step = 1e-3 * std::abs(centre.p);
        const TriaxialStress neighbours[] = {{centre.p + step, 0.0}, {centre.p - step, 0.0}, {centre.p, step}};
        return std::all_of(std::begin(neighbours), std::end(neighbours),
                           [&](const TriaxialStress& neighbour) { return is_elastic(centre, neighbour); });
    }

    const MaterialPoint& point_;
    double bulk_modulus_;
    double shear_modulus_;
    double scale_; // [Pa]
};

} // namespace

std::vector<TriaxialStress> yield_surface(const MaterialPoint& point, double scale)
{
    std::vector<TriaxialStress> surface;
    const DomainSearch search(point, scale);
    const std::optional<TriaxialStress> middle = search.middle();
    for (int n = 0; middle && n < directions; ++n) {
        const double angle = std::numbers::pi * n / (directions - 1);
        const TriaxialStress direction{std::cos(angle), std::sin(angle)};
        if (const std::optional<double> r = search.distance(*middle, direction))
            surface.push_back({middle->p + *r * direction.p, middle->q + *r * direction.q});
    }
    return surface;
}

} // namespace periporo
