// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Projects a position onto the places that are out of reach, by quadratic programs of three unknowns.
#include "contact/shortest_exit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace periporo {
namespace {

// Lengths over the reach of the contact.
constexpr double converged = 1e-9;    ///< change of the free position at which it is found
constexpr double satisfied = 1e-10;   ///< by which a limit may be missed
constexpr double bold_move = 0.5;     ///< of the free position, that might lead past a wall
constexpr double shortest_hop = 1e-3; ///< of a walk beside a surface; thinner solids are not seen

constexpr int most_turns = 50;
constexpr int most_hops = 10000;

/// Normals nearer to one line or plane than this (as a determinant) are not told apart.
constexpr double independent = 1e-14;

/// A move, and the limits that it meets exactly.
struct Attempt {
    ShortestExit exit;
    std::array<const FaceLimit*, 3> held = {};
};

/// The shortest move that meets the limits of `faces` exactly, or none when one of the faces would have to pull.
std::optional<Attempt> move_along(std::span<const FaceLimit* const> faces)
{
    using Index = Eigen::Index;
    Eigen::Matrix3d gram = Eigen::Matrix3d::Identity();
    Vector3 least = Vector3::Zero();
    for (std::size_t a = 0; a < faces.size(); ++a) {
        least[static_cast<Index>(a)] = faces[a]->least;
        for (std::size_t b = 0; b < faces.size(); ++b)
            gram(static_cast<Index>(a), static_cast<Index>(b)) = faces[a]->normal.dot(faces[b]->normal);
    }
    Eigen::Matrix3d inverse;
    bool invertible = false;
    gram.computeInverseWithCheck(inverse, invertible, independent);
    if (!invertible)
        return std::nullopt;
    const Vector3 shares = inverse * least;
    if ((shares.array() < 0.0).any())
        return std::nullopt;
    Attempt attempt;
    ShortestExit& exit = attempt.exit;
    for (std::size_t a = 0; a < faces.size(); ++a) {
        const double share = shares[static_cast<Index>(a)];
        if (share == 0.0)
            continue;
        attempt.held[exit.faces] = faces[a];
        exit.normals[exit.faces] = faces[a]->normal;
        exit.shares[exit.faces++] = share;
        exit.move += share * faces[a]->normal;
    }
    return attempt;
}

/// The shortest move that keeps what `now` holds and the limit `missed`, which it meets exactly.
std::optional<Attempt> with_limit(const Attempt& now, const FaceLimit* missed, double tolerance)
{
    const std::size_t others = now.exit.faces;
    const auto is_met = [&](const FaceLimit* limit, const ShortestExit& exit) {
        return limit->normal.dot(exit.move) >= limit->least - tolerance;
    };
    std::optional<Attempt> best;
    for (unsigned subset = 0; subset < 1u << others; ++subset) {
        if (subset == 7u)
            continue; // four faces
        std::array<const FaceLimit*, 3> faces{missed, nullptr, nullptr};
        std::size_t size = 1;
        for (std::size_t f = 0; f < others; ++f)
            if ((subset >> f & 1u) != 0)
                faces[size++] = now.held[f];
        const std::optional<Attempt> attempt = move_along({faces.data(), size});
        if (attempt && (!best || attempt->exit.move.squaredNorm() < best->exit.move.squaredNorm()) &&
            std::all_of(now.held.begin(), now.held.begin() + static_cast<std::ptrdiff_t>(others),
                        [&](const FaceLimit* limit) { return is_met(limit, attempt->exit); }))
            best = attempt;
    }
    return best;
}

/// Walks towards `to`, each time by the distance to the solid beyond `level`, and returns the first place where
/// `leaves_off` is true of that distance; none when it arrives.
/// @param hop the least part of the path that is walked at once [m]
template <class LeavesOff>
std::optional<Vector3> walk(const Geometry& geometry, const Vector3& from, const Vector3& to, double level, double hop,
                            const LeavesOff& leaves_off)
{
    const Vector3 path = to - from;
    const double length = path.norm();
    double along = 0.0;
    for (int n = 0; n < most_hops && along < length; ++n) {
        const Vector3 place = from + (along / length) * path;
        Vector3 normal;
        const double distance = geometry.signed_distance(place, normal);
        if (leaves_off(distance))
            return place;
        along += std::max(distance - level, hop);
    }
    return std::nullopt;
}

/// Does a straight path between two places outside lead through the solid?
bool leads_through(const Geometry& geometry, const Vector3& from, const Vector3& to, double reach)
{
    return walk(geometry, from, to, 0.0, shortest_hop * reach, [](double distance) { return distance < 0.0; })
        .has_value();
}

/// The first place on the path that is nearer to the solid than `level` (but for a hop), or its end.
Vector3 first_within(const Geometry& geometry, const Vector3& from, const Vector3& to, double level)
{
    const double hop = shortest_hop * level;
    return walk(geometry, from, to, level, hop, [&](double distance) { return distance <= level + hop; }).value_or(to);
}

/// Moves a place away from the nearest piece, again and again, until it is out of reach of all.
Vector3 lifted(const Geometry& geometry, Vector3 place, double reach, SurfacePieces& pieces)
{
    for (int turn = 0; turn < most_turns; ++turn) {
        pieces.clear();
        geometry.find_pieces(place, (1.0 - converged) * reach, pieces);
        if (pieces.empty())
            break;
        const SurfacePiece& nearest =
            *std::min_element(pieces.begin(), pieces.end(),
                              [](const SurfacePiece& a, const SurfacePiece& b) { return a.distance < b.distance; });
        place += (reach - nearest.distance) * nearest.normal;
    }
    return place;
}

/// Limits of the exit from `position` by the pieces seen from `place`, the nearest one first. Pieces farther than the
/// reach, or than the nearest one, plus `margin` are left out.
std::span<const FaceLimit> limits_beside(const SurfacePieces& pieces, const Vector3& position, const Vector3& place,
                                         double reach, double margin,
                                         std::array<FaceLimit, SurfacePieces::capacity>& limits)
{
    std::size_t first = 0;
    double least = std::numeric_limits<double>::infinity();
    for (const SurfacePiece& piece : pieces)
        least = std::min(least, piece.distance);
    const Vector3 offset = place - position;
    std::size_t count = 0;
    for (const SurfacePiece& piece : pieces) {
        if (piece.distance > std::max(least, reach) + margin)
            continue;
        if (piece.distance == least)
            first = count;
        limits[count++] = {piece.normal, reach - piece.distance + piece.normal.dot(offset)};
    }
    if (count > 0)
        std::swap(limits[0], limits[first]);
    return {limits.data(), count};
}

/// The exit from a position to the side on which `place` is. Each piece has a convex distance from the free position:
/// places behind its tangent plane are certainly out of its reach. The tangent planes lead to the next free position,
/// which has tangent planes of its own, until it no longer changes.
ShortestExit exit_beside(const Geometry& geometry, const Vector3& position, Vector3 place, double reach)
{
    SurfacePieces pieces;
    std::array<FaceLimit, SurfacePieces::capacity> storage;
    double margin = satisfied * reach;
    ShortestExit exit;
    place = lifted(geometry, place, reach, pieces);
    for (int turn = 0; turn < most_turns; ++turn) {
        pieces.clear();
        geometry.find_pieces(place, reach + std::max(margin, 2.0 * shortest_hop * reach), pieces);
        const auto limits = limits_beside(pieces, position, place, reach, margin, storage);
        // Limits contradict each other only where the place could not be lifted out of reach: the nearest face decides.
        if (!find_shortest_exit(limits, satisfied * reach, exit))
            find_shortest_exit(limits.first(1), satisfied * reach, exit);
        Vector3 next = position + exit.move;
        double change = (next - place).norm();
        if (change <= converged * reach)
            break;
        if (change > bold_move * reach) {
            next = lifted(geometry, first_within(geometry, place, next, bold_move * reach), reach, pieces);
            change = (next - place).norm();
        }
        margin = change;
        place = next;
    }
    return exit;
}

SolidContact no_contact(const Vector3& position)
{
    SolidContact contact;
    contact.free_position = position;
    return contact;
}

} // namespace

double ShortestExit::normal_force_factor() const
{
    if (faces <= 1)
        return 1.0;
    double sum = 0.0;
    for (std::size_t f = 0; f < faces; ++f)
        sum += shares[f];
    return sum / move.norm();
}

bool find_shortest_exit(std::span<const FaceLimit> limits, double tolerance, ShortestExit& exit)
{
    exit = {};
    Attempt now;
    // Every turn takes up the limit that is missed most, and the move grows: no set of faces comes twice.
    for (std::size_t turn = 0; turn < 2 * SurfacePieces::capacity; ++turn) {
        const FaceLimit* worst = nullptr;
        double most_missed = tolerance;
        for (const FaceLimit& limit : limits)
            if (const double missed = limit.least - limit.normal.dot(now.exit.move); missed > most_missed)
                most_missed = missed, worst = &limit;
        if (worst == nullptr) {
            exit = now.exit;
            return true;
        }
        const std::optional<Attempt> next = with_limit(now, worst, tolerance);
        if (!next)
            return false;
        now = *next;
    }
    return false;
}

SolidContact exit_at_nearest_face(const Vector3& position, double distance, const Vector3& normal, double reach)
{
    SolidContact contact;
    contact.exit.faces = 1;
    contact.exit.normals[0] = normal;
    contact.exit.shares[0] = reach - distance;
    contact.exit.move = (reach - distance) * normal;
    contact.free_position = position + contact.exit.move;
    return contact;
}

SolidContact find_exit(const Geometry& geometry, const Vector3& position, double distance, const Vector3& normal,
                       double reach, const Vector3& last_free_position)
{
    const bool known = last_free_position.x() == last_free_position.x();
    const double moved_squared = known ? (position - last_free_position).squaredNorm() : 0.0;
    if (!known || (distance > 0.0 && moved_squared < distance * distance)) { // no solid is between the two places
        if (distance >= reach)
            return no_contact(position);
        const SolidContact nearest = exit_at_nearest_face(position, distance, normal, reach);
        if (!geometry.has_pieces() || distance <= 0.0)
            return nearest;
        SurfacePieces pieces;
        geometry.find_pieces(nearest.free_position, (1.0 - converged) * reach, pieces);
        if (pieces.empty())
            return nearest;
        if (!known) {
            SolidContact contact;
            contact.exit = exit_beside(geometry, position, nearest.free_position, reach);
            contact.free_position = position + contact.exit.move;
            return contact;
        }
    } else if (distance >= reach && !leads_through(geometry, last_free_position, position, reach)) {
        return no_contact(position);
    }

    SolidContact contact;
    contact.exit = exit_beside(geometry, position, first_within(geometry, last_free_position, position, reach), reach);
    contact.free_position = position + contact.exit.move;
    const double overlap = (contact.free_position - position).norm();
    if (distance > 0.0 && overlap > reach && leads_through(geometry, position, contact.free_position, reach))
        contact = {.exit = {}, .free_position = position, .crossed = true};
    else if (distance >= reach)
        return no_contact(position);
    return contact;
}

} // namespace periporo
