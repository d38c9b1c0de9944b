// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "boolean": the union, difference or intersection of other geometries.
#include "counted_volume.hpp"

#include "periporo/geometry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>

namespace periporo::geometry {

namespace {

/// Over the largest coordinate of an operand: above the rounding of its distance, below all that matters of a body.
constexpr double surface_tolerance = 1e-12;
/// Two faces lie in one plane when the cosine of the angle between them differs by less from 1 or -1.
constexpr double parallel_tolerance = 1e-9;

bool overlap(const Bounds& a, const Bounds& b)
{
    return (a.lower.array() < b.upper.array()).all() && (b.lower.array() < a.upper.array()).all();
}

enum class Side { outside, surface, inside };

struct Location {
    Side side = Side::outside;
    Vector3 normal = Vector3::Zero(); ///< at the surface: the unit normal out of the body

    /// As seen from the rest of space.
    Location complement() const
    {
        const Side other = side == Side::outside ? Side::inside : side == Side::inside ? Side::outside : side;
        return {other, -normal};
    }
};

/// All three operations are intersections: A - B is that of A and the complement of B, and a union is the complement
/// of the intersection of the complements.
///
/// A union and an intersection contain what some or all operands do. The surface of what a difference takes away
/// stays, as far as the operand's distance tells; an operand without a distance takes its surface with it. Where faces
/// of two operands lie in one plane, no sheet without thickness is left: neither on a face that both the body and what
/// is taken from it end at, nor between two operands that are taken away and touch.
///
/// The signed distance is the largest of those of the intersection's operands, the least of those of a union. Its sign
/// is right everywhere. It is as exact as the operands' outside a union and inside a difference or an intersection; on
/// the other side, where the nearest point of the deciding operand's surface may lie within another one, it is a lower
/// bound. So what is taken away from an obstacle should reach beyond it: at a mouth that lies in one plane with the
/// surface around it the distance is almost zero, although nothing is there.
///
/// The pieces of a union are those of its operands. A piece of an intersection lies in one piece of every operand: seen
/// from inside a box that is taken away these are the planes of the box.
class Boolean : public Geometry {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records;
        records.push_back(Parameter::text("operation", "What is made of the operands")
                              .one_of({"union", "difference", "intersection"}));
        records.push_back(
            Parameter::geometries("of", "Names of two or more geometries; a difference is the first less all others"));
        return records;
    }

    explicit Boolean(const Parameters& parameters)
        : operation_(parameters.text("operation")), names_(parameters.text_list("of"))
    {
        if (names_.size() < 2)
            throw std::runtime_error(fmt::format("of must name two geometries or more to make a {}; it names {}",
                                                 operation_, names_.empty() ? "none" : '"' + names_.front() + '"'));
    }

    void set_operands(std::vector<std::shared_ptr<const Geometry>> operands) override
    {
        if (operands.size() != names_.size())
            throw std::logic_error(
                fmt::format("{} operands for the {} names of a boolean geometry", operands.size(), names_.size()));
        for (std::size_t n = 0; n < operands.size(); ++n) {
            const Bounds bounds = operands[n]->bounds();
            const bool complement = is_union() || (operation_ == "difference" && n > 0);
            const double size =
                std::max(bounds.lower.lpNorm<Eigen::Infinity>(), bounds.upper.lpNorm<Eigen::Infinity>());
            terms_.push_back({std::move(operands[n]), bounds, surface_tolerance * size, complement});
        }
        bounds_ = terms_.front().bounds;
        for (const Term& term : terms_) {
            if (is_union())
                bounds_ = {bounds_.lower.cwiseMin(term.bounds.lower), bounds_.upper.cwiseMax(term.bounds.upper)};
            else if (operation_ == "intersection")
                bounds_ = {bounds_.lower.cwiseMax(term.bounds.lower), bounds_.upper.cwiseMin(term.bounds.upper)};
        }
        if (!overlap(bounds_, bounds_))
            throw std::runtime_error(empty_message());
    }

    bool contains(const Vector3& position) const override
    {
        const auto contained = [&](const Term& term) { return term.operand->contains(position); };
        if (is_union())
            return std::any_of(terms_.begin(), terms_.end(), contained);
        if (operation_ == "intersection")
            return std::all_of(terms_.begin(), terms_.end(), contained);
        return contained(terms_.front()) &&
               (std::none_of(terms_.begin() + 1, terms_.end(), contained) || locate(position).side != Side::outside);
    }

    Bounds bounds() const override { return bounds_; }

    double volume() const override { return counted().volume; }

    PointCloud fill(double spacing) const override
    {
        volume(); // says so when there is nothing to fill
        return Geometry::fill(spacing);
    }

    bool has_distance() const override
    {
        return std::all_of(terms_.begin(), terms_.end(), [](const Term& term) { return term.operand->has_distance(); });
    }

    double signed_distance(const Vector3& position, Vector3& normal) const override
    {
        double largest = -std::numeric_limits<double>::infinity();
        for (const Term& term : terms_) {
            Vector3 direction;
            const double sign = term.complement ? -1.0 : 1.0;
            const double distance = sign * term.operand->signed_distance(position, direction);
            if (distance <= largest)
                continue;
            largest = distance;
            normal = sign * direction;
        }
        if (!is_union())
            return largest;
        normal = -normal;
        return -largest;
    }

    bool has_pieces() const override { return true; }

    void find_pieces(const Vector3& position, double reach, SurfacePieces& pieces) const override
    {
        if (is_union())
            add_pieces_of_all(position, reach, false, pieces);
        else
            add_common_pieces(position, reach, pieces);
    }

    void find_pieces_from_within(const Vector3& position, double reach, SurfacePieces& pieces) const override
    {
        if (is_union())
            add_common_pieces(position, reach, pieces);
        else
            add_pieces_of_all(position, reach, true, pieces);
    }

    std::vector<std::string> remarks() const override
    {
        const CountedVolume& found = counted();
        if (found.error == 0.0)
            return {};
        return {fmt::format("volume by counting, +- {:.2g} per cent", 100.0 * found.error / found.volume)};
    }

private:
    struct Term {
        std::shared_ptr<const Geometry> operand;
        Bounds bounds;
        double tolerance; ///< a distance this small is one of the surface [m]
        bool complement;  ///< of the operand
    };

    bool is_union() const { return operation_ == "union"; }

    static void find_pieces(const Term& term, bool complement, const Vector3& position, double reach,
                            SurfacePieces& pieces)
    {
        if (complement)
            term.operand->find_pieces_from_within(position, reach, pieces);
        else
            term.operand->find_pieces(position, reach, pieces);
    }

    /// The pieces of a union of the operands, or of the complements of the terms of an intersection.
    void add_pieces_of_all(const Vector3& position, double reach, bool complements, SurfacePieces& pieces) const
    {
        for (const Term& term : terms_)
            find_pieces(term, complements && !term.complement, position, reach, pieces);
    }

    /// What pieces of all terms of the intersection have in common: a piece of every term. It is no nearer than the
    /// farthest of them, as signed_distance() has it too.
    void add_common_pieces(const Vector3& position, double reach, SurfacePieces& pieces) const
    {
        SurfacePieces common;
        bool first = true;
        for (const Term& term : terms_) {
            SurfacePieces of_term;
            Vector3 normal;
            const double sign = term.complement ? -1.0 : 1.0;
            const double distance = sign * term.operand->signed_distance(position, normal);
            if (distance <= 0.0) // wherever the other terms have a surface, this one is solid
                of_term.add(distance, sign * normal);
            else
                find_pieces(term, term.complement, position, reach, of_term);
            if (first)
                common = of_term;
            else
                common = in_common(common, of_term);
            first = false;
        }
        for (const SurfacePiece& piece : common)
            pieces.add(piece.distance, piece.normal);
    }

    static SurfacePieces in_common(const SurfacePieces& a, const SurfacePieces& b)
    {
        SurfacePieces common;
        for (const SurfacePiece& p : a)
            for (const SurfacePiece& q : b) {
                const SurfacePiece& farther = p.distance > q.distance ? p : q;
                common.add(farther.distance, farther.normal);
            }
        return common;
    }

    /// Of the operand, not of its complement.
    static Location locate(const Term& term, const Vector3& position)
    {
        if (const auto* boolean = dynamic_cast<const Boolean*>(term.operand.get()))
            return boolean->locate(position);
        if (!term.operand->contains(position))
            return {};
        Location location{Side::inside};
        if (term.operand->has_distance() && term.operand->signed_distance(position, location.normal) >= -term.tolerance)
            location.side = Side::surface;
        return location;
    }

    Location locate(const Vector3& position) const
    {
        const Location location = locate_in_intersection(position);
        return is_union() ? location.complement() : location;
    }

    Location locate_in_intersection(const Vector3& position) const
    {
        std::vector<Vector3> normals;
        for (const Term& term : terms_) {
            const Location operand = locate(term, position);
            const Location location = term.complement ? operand.complement() : operand;
            if (location.side == Side::outside)
                return {};
            if (location.side == Side::surface)
                normals.push_back(location.normal);
        }
        if (normals.empty())
            return {Side::inside};
        // Half-spaces back to back leave a plane between them.
        if (operation_ != "intersection")
            for (std::size_t n = 1; n < normals.size(); ++n)
                for (std::size_t m = 0; m < n; ++m)
                    if (normals[m].dot(normals[n]) < parallel_tolerance - 1.0)
                        return {};
        return {Side::surface, normals.front()};
    }

    /// See CountedRegion.
    std::optional<bool> decided(const Vector3& centre, double radius) const
    {
        bool inside = true;
        for (const Term& term : terms_) {
            const std::optional<bool> operand = decided(term, centre, radius);
            if (!operand)
                inside = false;
            else if (*operand == term.complement)
                return is_union();
        }
        return inside ? std::optional(!is_union()) : std::nullopt;
    }

    static std::optional<bool> decided(const Term& term, const Vector3& centre, double radius)
    {
        if (term.operand->has_distance()) {
            Vector3 normal;
            const double distance = term.operand->signed_distance(centre, normal);
            return std::abs(distance) > radius ? std::optional(distance < 0.0) : std::nullopt;
        }
        const Vector3 reach = Vector3::Constant(radius);
        return overlap({centre - reach, centre + reach}, term.bounds) ? std::nullopt : std::optional(false);
    }

    const CountedVolume& counted() const
    {
        std::call_once(counted_once_, [this] {
            counted_ = find_volume();
            if (!(counted_.volume > 0.0))
                throw std::runtime_error(empty_message());
        });
        return counted_;
    }

    /// With no error where volumes of operands make up the volume.
    CountedVolume find_volume() const
    {
        if (operands_meet())
            return count_volume({bounds_, [this](const Vector3& position) { return contains(position); },
                                 [this](const Vector3& centre, double radius) { return decided(centre, radius); }});
        double volume = terms_.front().operand->volume();
        for (std::size_t n = 1; is_union() && n < terms_.size(); ++n)
            volume += terms_[n].operand->volume();
        return {volume, 0.0};
    }

    /// May operands of a union have parts in common, or a difference take something away?
    bool operands_meet() const
    {
        if (operation_ == "intersection")
            return true;
        for (std::size_t n = 1; n < terms_.size(); ++n)
            for (std::size_t m = 0; m < (is_union() ? n : 1); ++m)
                if (overlap(terms_[m].bounds, terms_[n].bounds))
                    return true;
        return false;
    }

    std::string empty_message() const
    {
        return fmt::format("the {} of {} is empty, or too thin to be found; check the places and sizes of these "
                           "geometries",
                           operation_, fmt::join(names_, ", "));
    }

    std::string operation_;
    std::vector<std::string> names_;
    std::vector<Term> terms_;
    Bounds bounds_;
    mutable std::once_flag counted_once_;
    mutable CountedVolume counted_;
};

} // namespace

} // namespace periporo::geometry

PERIPORO_PLUGIN(periporo::PluginKind::geometry, periporo::geometry::Boolean, "boolean",
                "A union, difference or intersection of other geometries")
