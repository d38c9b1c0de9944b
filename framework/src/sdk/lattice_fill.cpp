// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Fills any geometry with the cells of a cubic lattice.
#include "periporo/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <future>
#include <numeric>
#include <stdexcept>
#include <thread>

namespace periporo {
namespace {

constexpr long divisions = 4; ///< along each edge of a cell, with one sample in each division
constexpr long samples_of_cell = divisions * divisions * divisions;
constexpr double most_cells = 1e9;           ///< of the box around a geometry
constexpr double most_cells_searched = 1e6;  ///< for a message
constexpr double finest_search = 1.0 / 64.0; ///< of the spacing, for a message

using Cell = Eigen::Matrix<long, 3, 1>;

/// Cells around the bounds of a geometry, one more on each side included.
class Lattice {
public:
    Lattice(const LatticeFrame& frame, double spacing)
        : frame_(frame), spacing_(spacing), first_(first_cell(frame.bounds, spacing)),
          counts_(cells_along(frame.bounds, spacing).cast<long>())
    {
    }

    /// Numbers of cells along the edges of the box around a geometry, which may be beyond all integers.
    static Vector3 cells_along(const Bounds& bounds, double spacing)
    {
        return ((bounds.upper / spacing).array().ceil() + 1.0) - first_cell(bounds, spacing).array();
    }

    std::size_t size() const { return static_cast<std::size_t>(counts_.prod()); }
    std::size_t index(const Cell& cell) const
    {
        return static_cast<std::size_t>((cell.z() * counts_.y() + cell.y()) * counts_.x() + cell.x());
    }
    Vector3 centre(const Cell& cell) const { return position(cell, Vector3::Zero()); }
    /// Of a place within a cell, from -1/2 to 1/2 along each edge outwards, as seen from the frame's origin: cells on
    /// both sides of it are mirror images.
    Vector3 position(const Cell& cell, const Vector3& place) const
    {
        const Vector3 middle = first_ + cell.cast<double>() + Vector3::Constant(0.5);
        return frame_.origin + frame_.axes * (spacing_ * (middle + place.cwiseProduct(middle.cwiseSign())));
    }

    /// Calls visit(cell) for the cells that have neighbours on all sides, in order.
    template <class Visit>
    void visit(const Visit& visit) const
    {
        for (long z = 1; z + 1 < counts_.z(); ++z)
            visit_layer(z, visit);
    }
    /// The same with the layers shared out among threads.
    template <class Visit>
    void visit_in_parallel(const Visit& visit) const
    {
        const long threads = std::max(1L, static_cast<long>(std::thread::hardware_concurrency()));
        std::vector<std::future<void>> workers;
        for (long thread = 0; thread < threads; ++thread)
            workers.push_back(std::async(std::launch::async, [&, thread] {
                for (long z = 1 + thread; z + 1 < counts_.z(); z += threads)
                    visit_layer(z, visit);
            }));
        for (std::future<void>& worker : workers)
            worker.get(); // and throws what a geometry threw
    }

private:
    static Vector3 first_cell(const Bounds& bounds, double spacing)
    {
        return (bounds.lower / spacing).array().floor() - 1.0;
    }

    template <class Visit>
    void visit_layer(long z, const Visit& visit) const
    {
        for (long y = 1; y + 1 < counts_.y(); ++y)
            for (long x = 1; x + 1 < counts_.x(); ++x)
                visit(Cell(x, y, z));
    }

    LatticeFrame frame_;
    double spacing_;
    Vector3 first_; ///< in spacings
    Cell counts_;
};

/// @throws std::runtime_error when there are no cells, or more than a computation could hold.
void require_sensible_size(const Bounds& bounds, double spacing)
{
    const Vector3 edges = bounds.upper - bounds.lower;
    if (!(edges.array() >= 0.0).all())
        throw std::runtime_error("the geometry is empty, there is no box around it");
    const double cells = Lattice::cells_along(bounds, spacing).prod();
    if (!(cells < most_cells))
        throw std::runtime_error(fmt::format("a spacing of {:.6g} m makes {:.3g} lattice cells in the box around the "
                                             "geometry, {:.6g} x {:.6g} x {:.6g} m; is the spacing, or a unit of the "
                                             "geometry, wrong?",
                                             spacing, cells, edges.x(), edges.y(), edges.z()));
}

/// The 26 neighbours of a cell, nearest first.
const std::array<Cell, 26>& neighbours()
{
    static const std::array<Cell, 26> offsets = [] {
        std::array<Cell, 26> all;
        std::size_t count = 0;
        for (long z = -1; z <= 1; ++z)
            for (long y = -1; y <= 1; ++y)
                for (long x = -1; x <= 1; ++x)
                    if (x != 0 || y != 0 || z != 0)
                        all[count++] = Cell(x, y, z);
        std::stable_sort(all.begin(), all.end(),
                         [](const Cell& a, const Cell& b) { return a.squaredNorm() < b.squaredNorm(); });
        return all;
    }();
    return offsets;
}

/// Where a cell is sampled, from -1/2 to 1/2 along each edge. Rows and columns of samples are shifted against each
/// other, so that they stand in 16 planes across each edge, not in 4, and see the place of a face that much better.
const std::array<Vector3, samples_of_cell>& sample_places()
{
    static const std::array<Vector3, samples_of_cell> places = [] {
        std::array<Vector3, samples_of_cell> all;
        std::size_t count = 0;
        const auto place = [](long own, long one, long other) {
            const long plane = divisions * own + (one + other) % divisions;
            return (static_cast<double>(plane) + 0.5) / (divisions * divisions) - 0.5;
        };
        for (long z = 0; z < divisions; ++z)
            for (long y = 0; y < divisions; ++y)
                for (long x = 0; x < divisions; ++x)
                    all[count++] = Vector3(place(x, y, z), place(y, z, x), place(z, x, y));
        return all;
    }();
    return places;
}

/// What of each cell lies inside a geometry.
class Filling {
public:
    Filling(const Geometry& geometry, const Lattice& lattice);

    bool is_empty() const { return std::find(inside_.begin(), inside_.end(), 1) == inside_.end(); }
    bool has_centre_inside(const Cell& cell) const { return inside_[lattice_.index(cell)] != 0; }
    /// Volume of the point of a cell, in a unit of its own. Whole numbers, so that a lattice and its mirror image agree
    /// to the last bit, in whichever order they are added up.
    long volume(const Cell& cell) const;

private:
    /// The nearest neighbours with their centres inside.
    struct Heirs {
        long squared_distance = 0;
        long count = 0;
    };

    bool is_at_surface(const Cell& cell) const;
    std::uint8_t count_samples(const Geometry& geometry, const Cell& cell) const;
    Heirs heirs_of(const Cell& cell) const;

    const Lattice& lattice_;
    std::vector<std::uint8_t> inside_;  ///< is the centre of a cell inside?
    std::vector<std::uint8_t> samples_; ///< of a cell that are inside
};

Filling::Filling(const Geometry& geometry, const Lattice& lattice)
    : lattice_(lattice), inside_(lattice.size(), 0), samples_(lattice.size(), 0)
{
    lattice.visit_in_parallel(
        [&](const Cell& cell) { inside_[lattice.index(cell)] = geometry.contains(lattice.centre(cell)) ? 1 : 0; });
    lattice.visit_in_parallel([&](const Cell& cell) {
        std::uint8_t& count = samples_[lattice.index(cell)];
        if (is_at_surface(cell))
            count = count_samples(geometry, cell);
        else
            count = has_centre_inside(cell) ? samples_of_cell : 0;
    });
}

bool Filling::is_at_surface(const Cell& cell) const
{
    return std::any_of(neighbours().begin(), neighbours().end(),
                       [&](const Cell& offset) { return has_centre_inside(cell + offset) != has_centre_inside(cell); });
}

std::uint8_t Filling::count_samples(const Geometry& geometry, const Cell& cell) const
{
    long count = 0;
    for (const Vector3& sample : sample_places())
        count += geometry.contains(lattice_.position(cell, sample)) ? 1 : 0;
    // A geometry thin enough may hold the centre and pass between the samples, and no point may have a volume of zero.
    return static_cast<std::uint8_t>(std::max(count, has_centre_inside(cell) ? 1L : 0L));
}

Filling::Heirs Filling::heirs_of(const Cell& cell) const
{
    Heirs heirs;
    for (const Cell& offset : neighbours()) {
        if (heirs.count > 0 && offset.squaredNorm() > heirs.squared_distance)
            break;
        if (has_centre_inside(cell + offset)) {
            heirs.squared_distance = offset.squaredNorm();
            ++heirs.count;
        }
    }
    return heirs;
}

long Filling::volume(const Cell& cell) const
{
    constexpr long divisible = 27720; // by every number of heirs: at most 6 by a face, 12 by an edge or 8 by a corner
    long sum = divisible * samples_[lattice_.index(cell)];
    for (const Cell& offset : neighbours()) {
        const Cell other = cell + offset;
        const long samples = samples_[lattice_.index(other)];
        if (samples == 0 || has_centre_inside(other))
            continue;
        const Heirs heirs = heirs_of(other);
        if (offset.squaredNorm() == heirs.squared_distance)
            sum += divisible / heirs.count * samples;
    }
    return sum;
}

/// "; a spacing of 0.025 m would give some", found by halving, or an empty text when none is found soon.
std::string fitting_spacing(const Geometry& geometry, double spacing, const LatticeFrame& frame)
{
    for (double finer = spacing / 2.0; finer > spacing * finest_search; finer /= 2.0) {
        if (Lattice::cells_along(frame.bounds, finer).prod() > most_cells_searched)
            break;
        if (!Filling(geometry, Lattice(frame, finer)).is_empty())
            return fmt::format("; a spacing of {:.6g} m would give some", finer);
    }
    return "; give a smaller spacing, a larger body or another place";
}

/// Brings the sum of the volumes to the given one.
void scale_to(double volume, std::vector<double>& volumes)
{
    if (!(volume > 0.0) || !std::isfinite(volume))
        throw std::runtime_error(fmt::format("the volume of the geometry must be positive, it is {} m3", volume));
    const double scale = volume / std::accumulate(volumes.begin(), volumes.end(), 0.0);
    for (double& part : volumes)
        part *= scale;
}

} // namespace

PointCloud fill_by_lattice(const Geometry& geometry, double spacing, const LatticeFrame& frame)
{
    if (!(spacing > 0.0) || !std::isfinite(spacing))
        throw std::runtime_error(fmt::format("the spacing must be positive, it is {} m", spacing));
    require_sensible_size(frame.bounds, spacing);
    const Lattice lattice(frame, spacing);
    const Filling filling(geometry, lattice);
    PointCloud cloud;
    lattice.visit([&](const Cell& cell) {
        if (!filling.has_centre_inside(cell))
            return;
        cloud.positions.push_back(lattice.centre(cell));
        cloud.volumes.push_back(static_cast<double>(filling.volume(cell)));
    });
    if (cloud.positions.empty())
        throw std::runtime_error(fmt::format("no lattice cell of spacing {:.6g} m has its centre inside{}", spacing,
                                             fitting_spacing(geometry, spacing, frame)));
    scale_to(geometry.volume(), cloud.volumes);
    return cloud;
}

PointCloud fill_by_lattice(const Geometry& geometry, double spacing)
{
    return fill_by_lattice(geometry, spacing, {.bounds = geometry.bounds()});
}

PointCloud Geometry::fill(double spacing) const
{
    return fill_by_lattice(*this, spacing);
}

} // namespace periporo
