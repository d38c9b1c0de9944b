// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Images of points under isometries: what symmetry planes and periodic pairs are to the operator.
#pragma once

#include "io/archive.hpp"
#include "periporo/tensor.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace periporo {

/// x -> Q x + t with Q orthogonal.
struct Isometry {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Vector3 translation = Vector3::Zero();

    Vector3 point(const Vector3& x) const { return rotation * x + translation; }
    Vector3 direction(const Vector3& v) const { return rotation * v; }
    /// First `second`, then this.
    Isometry after(const Isometry& second) const
    {
        return {rotation * second.rotation, rotation * second.translation + translation};
    }
    Isometry inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
    /// The mirror image at the plane x_axis = offset.
    static Isometry reflection(int axis, double offset);
    static Isometry shift(int axis, double distance);
};
template <>
inline constexpr std::size_t reals_of<Isometry> = 12;

/// Isometries by number. A number, once given, keeps its meaning for the whole run, so that bonds to images can be
/// recognised from one refresh to the next. Number 0 is the identity.
class IsometryTable {
public:
    IsometryTable();

    /// Declares what generates images from now on (reflections and shifts; their inverses are added).
    void set_generators(std::vector<Isometry> generators);

    /// The products of the generators, identity left out, that bring some point of the box [lower, upper] within
    /// `reach` of the box. New ones get new numbers, together with their inverses.
    /// @throws std::runtime_error when there are more than 4096 of them, as two planes at an odd angle would make.
    std::vector<std::uint32_t> active(const Vector3& lower, const Vector3& upper, double reach);

    /// The number of an isometry, if it has one.
    std::optional<std::uint32_t> find(const Isometry& isometry) const;

    const Isometry& operator[](std::uint32_t number) const { return isometries_[number]; }
    std::uint32_t inverse(std::uint32_t number) const { return inverses_[number]; }
    std::size_t size() const { return isometries_.size(); }
    /// Isometries in the order of their numbers: those in use now are found again under the number that they had.
    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        visit("isometries", at_most(self.isometries_, 65536));
    }
    /// Sets what follows from the members.
    /// @throws std::runtime_error when they are no isometries, or the first is not the identity
    void resume();

private:
    std::uint32_t number_of(const Isometry& isometry);

    std::vector<Isometry> generators_;
    std::vector<Isometry> isometries_;
    std::vector<std::uint32_t> inverses_;
};

/// An image: which point, under which isometry.
struct Image {
    std::uint32_t parent;
    std::uint32_t isometry;
};

/// All images whose position lies within `reach` of the box around the points; ordered by isometry, then parent.
std::vector<Image> find_images(std::span<const Vector3> positions, IsometryTable& isometries, double reach);

} // namespace periporo
