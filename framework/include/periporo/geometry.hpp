// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Interface of geometry plugins: a solid region, the material points that fill it, and the distance from its surface.
#pragma once

#include "periporo/plugin.hpp"
#include "periporo/vector.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace periporo {

/// An axis-aligned box, [m].
struct Bounds {
    Vector3 lower = Vector3::Zero();
    Vector3 upper = Vector3::Zero();
};

/// Material points that fill a body.
struct PointCloud {
    std::vector<Vector3> positions; ///< [m]
    std::vector<double> volumes;    ///< [m3]; their sum may differ from the geometry's volume, which is reported
};

/// A convex part of a solid, or the plane of one of its faces, as seen from a position.
struct SurfacePiece {
    double distance; ///< from the position, positive on the free side [m]
    Vector3 normal;  ///< unit direction in which the distance grows fastest
};

/// The pieces of a surface near a position; the nearest ones where there are more than fit. Takes no memory elsewhere.
class SurfacePieces {
public:
    static constexpr std::size_t capacity = 32;

    /// Triangles of one plane, or around one corner, that are the same piece from here are kept once.
    void add(double distance, const Vector3& normal);
    void clear() { count_ = 0; }
    bool empty() const { return count_ == 0; }
    std::size_t size() const { return count_; }
    const SurfacePiece* begin() const { return pieces_.data(); }
    const SurfacePiece* end() const { return pieces_.data() + count_; }

private:
    std::size_t count_ = 0;
    std::array<SurfacePiece, capacity> pieces_;
};

/// A solid region. Everything but set_operands() is called from several threads at once.
class Geometry {
public:
    virtual ~Geometry() = default;

    /// Called once, before any other call, with the geometries that the parameter made by Parameter::geometries()
    /// names, in its order. They live as long as they are held.
    virtual void set_operands(std::vector<std::shared_ptr<const Geometry>> operands) { static_cast<void>(operands); }

    /// True inside and on the surface, decided exactly for the coordinates as given.
    virtual bool contains(const Vector3& position) const = 0;
    /// The smallest axis-aligned box around the geometry, or a box that holds it where the smallest is not known.
    virtual Bounds bounds() const = 0;
    /// Volume [m3], exact where a formula exists; where it does not, remarks() says how it was found.
    virtual double volume() const = 0;
    /// Fills the geometry with material points about `spacing` [m] apart. Unless a geometry knows a better way, it is
    /// fill_by_lattice().
    /// @throws std::runtime_error when the spacing does not fit, saying what would.
    virtual PointCloud fill(double spacing) const;

    /// Can the geometry be a rigid obstacle, that is, does it answer signed_distance()?
    virtual bool has_distance() const { return false; }
    /// Signed distance from the surface [m], positive outside; `normal` becomes the unit direction in which it grows
    /// fastest. Near an edge it is the distance to the edge.
    /// @throws std::logic_error unless has_distance().
    virtual double signed_distance(const Vector3& position, Vector3& normal) const;

    /// Can find_pieces() find more than one piece? A convex solid has one. A solid with notches, valleys or cavities
    /// that answers true, and overrides find_pieces(), lets a point rest on all faces of a concave corner.
    virtual bool has_pieces() const { return false; }
    /// Adds the pieces of the solid that are nearer than `reach` [m] to a position outside of it: convex parts whose
    /// union it is, or triangles of its surface. A piece may end within another one; where faces of two pieces are
    /// flush, their common edge is not felt. Unless overridden it is the one piece of signed_distance().
    virtual void find_pieces(const Vector3& position, double reach, SurfacePieces& pieces) const;
    /// The same of the rest of space, for a position inside the solid: the planes of a box, seen from within. With it
    /// the solid can be taken away from another one. Unless overridden it is the one piece of signed_distance().
    virtual void find_pieces_from_within(const Vector3& position, double reach, SurfacePieces& pieces) const;

    /// What a user should know of the geometry as made: what was repaired, what was left out, how its volume was found.
    virtual std::vector<std::string> remarks() const { return {}; }
};

/// Where the cells of a lattice lie: along axes of their own, with a corner in an origin.
struct LatticeFrame {
    Vector3 origin = Vector3::Zero();                   ///< [m]
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(); ///< columns at right angles and of length 1
    Bounds bounds;                                      ///< of the geometry along the axes, from the origin [m]
};

/// Points in the middle of the cubic cells, `spacing` [m] wide, that have their centres inside a geometry. Planes
/// through the origin along the axes cut no cell. The volume of a point is that of the part of its cell that lies
/// inside, as far as 64 samples in a cell at the surface tell; what lies in cells whose centres are outside
/// goes to the nearest points. In the end all are scaled alike, so that the volumes add up to the geometry's. Parts
/// thinner than the spacing get no points where they miss the centres, and their volume is spread over all points.
/// @throws std::runtime_error when no centre of a cell lies inside, with a spacing that would fit.
PointCloud fill_by_lattice(const Geometry& geometry, double spacing, const LatticeFrame& frame);
/// The same along the axes of coordinates, with a corner of cells in their origin.
PointCloud fill_by_lattice(const Geometry& geometry, double spacing);

} // namespace periporo
