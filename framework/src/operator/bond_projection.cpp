// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "operator/bond_projection.hpp"

#include "operator/bond_forces.hpp"
#include "operator/bond_update.hpp"

#include <array>
#include <bit>

namespace periporo {
namespace {

/// What a point lends to its bonds. Images hold theirs in their own frame, so that bonds need not ask.
struct PointKinematics {
    Tensor<double> gradient;               ///< L_i
    SymmetricTensor<double> inverse_shape; ///< K_i^-1
    Tensor<double> moment;                 ///< A_i K_i^-1
    double reciprocal_weight = 0.0;        ///< 1/w0_i; 0 when no bond is active
    bool sound = false;                    ///< K_i can be inverted
};

Tensor<double> in_frame_of(const Isometry& isometry, const Tensor<double>& t)
{
    Eigen::Matrix3d m;
    m << t.xx, t.xy, t.xz, t.yx, t.yy, t.yz, t.zx, t.zy, t.zz;
    const Eigen::Matrix3d r = isometry.rotation * m * isometry.rotation.transpose();
    return {r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)};
}

/// Buffers of one thread: rows of one value a bond.
struct Workspace {
    AlignedVector<double> rows[10]; // zeta/|zeta|^2 (3), omega, velocity difference (3), zeta (3)
    AlignedVector<double> volume;
    AlignedVector<double> gradient;
    StressWorkspace stress;

    void reserve(std::size_t packs)
    {
        if (volume.size() < packs * pack_width) {
            for (auto& row : rows)
                row.resize(packs * pack_width);
            volume.resize(packs * pack_width);
        }
        gradient.resize(9 * packs * pack_width);
        stress.reserve(packs);
    }
};

enum Row : std::size_t { direction = 0, omega_row = 3, velocity = 4, bond = 7 };

/// Lanes behind the last bond get zero influence, direction and volume.
void gather(const Model& model, std::size_t point, const FamilyView& family, const Influence& influence, Workspace& w)
{
    const NeighbourRecord& self = model.records[point];
    for (std::size_t b = 0; b < family.packs * pack_width; ++b) {
        const NeighbourRecord& other = model.records[family.neighbours[b]];
        for (std::size_t c = 0; c < 3; ++c) {
            w.rows[bond + c][b] = other.position[c] - self.position[c];
            w.rows[velocity + c][b] = other.velocity[c] - self.velocity[c];
        }
        w.volume[b] = b < family.count ? other.volume : 0.0;
    }
    for (std::size_t at = 0; at < family.packs * pack_width; at += pack_width) {
        const Pack x = load_pack(&w.rows[bond][at]);
        const Pack y = load_pack(&w.rows[bond + 1][at]);
        const Pack z = load_pack(&w.rows[bond + 2][at]);
        const Pack squared = x * x + y * y + z * z;
        const PackMask real = squared > Pack(0.0);
        const Pack reciprocal = select(real, Pack(1.0) / squared, Pack(0.0));
        store_pack(x * reciprocal, &w.rows[direction][at]);
        store_pack(y * reciprocal, &w.rows[direction + 1][at]);
        store_pack(z * reciprocal, &w.rows[direction + 2][at]);
        store_pack(select(real, influence(squared), Pack(0.0)), &w.rows[omega_row][at]);
    }
}

/// Calls visit(point, family, workspace) for every point, in parallel, with its family gathered.
template <class Visit>
void for_every_family(const Model& model, const Influence& influence, Visit&& visit)
{
#pragma omp parallel
    {
        Workspace w;
#pragma omp for schedule(dynamic, 32)
        for (std::size_t i = 0; i < model.size(); ++i) {
            const FamilyView family = model.families[i];
            w.reserve(family.packs);
            gather(model, i, family, influence, w);
            visit(i, family, w);
        }
    }
}

struct BondGeometry {
    Pack x, y, z;    ///< zeta
    Pack nx, ny, nz; ///< zeta/|zeta|^2
    Pack u, v, t;    ///< v_j - v_i
    Pack omega, volume;
};

BondGeometry geometry(const Workspace& w, std::size_t at)
{
    const auto row = [&](std::size_t r) { return load_pack(&w.rows[r][at]); };
    return {row(bond),          row(bond + 1),      row(bond + 2),           row(direction),
            row(direction + 1), row(direction + 2), row(velocity),           row(velocity + 1),
            row(velocity + 2),  row(omega_row),     load_pack(&w.volume[at])};
}

/// Gathers member `field` of the point kinematics of the neighbours, component by component.
template <std::size_t components, class Read>
std::array<Pack, components> gather_point(const std::vector<PointKinematics>& points, const std::uint32_t* neighbours,
                                          Read&& read)
{
    alignas(64) double buffer[components][pack_width];
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        const std::array<double, components> values = read(points[neighbours[lane]]);
        for (std::size_t c = 0; c < components; ++c)
            buffer[c][lane] = values[c];
    }
    std::array<Pack, components> packs;
    for (std::size_t c = 0; c < components; ++c)
        packs[c] = load_pack(buffer[c]);
    return packs;
}

std::array<double, 9> components(const Tensor<double>& t)
{
    return {t.xx, t.xy, t.xz, t.yx, t.yy, t.yz, t.zx, t.zy, t.zz};
}

/// K_i, L_i and whether they exist.
PointKinematics point_kinematics(const FamilyView& family, const Workspace& w)
{
    SymmetricTensor<Pack> shape;
    Tensor<Pack> moment;
    for (std::size_t at = 0; at < family.packs * pack_width; at += pack_width) {
        const BondGeometry g = geometry(w, at);
        const Pack weight = g.omega * g.volume;
        shape += SymmetricTensor<Pack>{g.x * g.nx, g.y * g.ny, g.z * g.nz, g.x * g.ny, g.y * g.nz, g.x * g.nz} * weight;
        moment += Tensor<Pack>{g.u * g.nx, g.u * g.ny, g.u * g.nz, g.v * g.nx, g.v * g.ny,
                               g.v * g.nz, g.t * g.nx, g.t * g.ny, g.t * g.nz} *
                  weight;
    }
    PointKinematics point;
    const SymmetricTensor<double> k{reduce(shape.xx), reduce(shape.yy), reduce(shape.zz),
                                    reduce(shape.xy), reduce(shape.yz), reduce(shape.xz)};
    const double mean = trace(k) / 3.0;
    const double det = determinant(k);
    point.sound = mean > 0.0 && det >= least_shape_quality * mean * mean * mean;
    if (point.sound) {
        point.inverse_shape = adjugate(k) * (1.0 / det);
        point.gradient = Tensor<double>{reduce(moment.xx), reduce(moment.xy), reduce(moment.xz),
                                        reduce(moment.yx), reduce(moment.yy), reduce(moment.yz),
                                        reduce(moment.zx), reduce(moment.zy), reduce(moment.zz)} *
                         point.inverse_shape;
    }
    return point;
}

/// Finds the active bonds of a point and returns 1/w0, once the soundness of all points is known.
double find_activity(Model& model, const std::vector<PointKinematics>& points, std::size_t i,
                     const Influence& influence)
{
    const FamilyView family = model.families[i];
    double weight = 0.0;
    std::uint32_t active = 0;
    const NeighbourRecord& self = model.records[i];
    for (std::size_t p = 0; p < family.packs; ++p) {
        std::uint8_t bits = 0;
        for (std::size_t lane = 0; lane < pack_width; ++lane) {
            const std::size_t b = p * pack_width + lane;
            if (b >= family.count || !points[i].sound || !points[family.neighbours[b]].sound)
                continue;
            const NeighbourRecord& other = model.records[family.neighbours[b]];
            double squared = 0.0;
            for (std::size_t c = 0; c < 3; ++c)
                squared += (other.position[c] - self.position[c]) * (other.position[c] - self.position[c]);
            if (squared < shortest_bond * shortest_bond * model.spacing * model.spacing)
                continue;
            bits = static_cast<std::uint8_t>(bits | 1u << lane);
            weight += influence(squared) * other.volume;
            ++active;
        }
        model.bonds.active[family.first_pack + p] = bits;
    }
    model.inactive_bonds[i] = static_cast<std::uint32_t>(family.count) - active;
    model.free_grain[i] = active == 0 ? 1 : 0;
    return weight > 0.0 ? 1.0 / weight : 0.0;
}

/// S_ij = omega (1/w0_i + 1/w0_j) of a pack, zero where inactive.
Pack mutual_weight(const std::vector<PointKinematics>& points, std::size_t i, const std::uint32_t* neighbours,
                   const Pack& omega, std::uint8_t active)
{
    const auto other =
        gather_point<1>(points, neighbours, [](const PointKinematics& k) { return std::array{k.reciprocal_weight}; });
    return select(lane_mask(active), omega * (points[i].reciprocal_weight + other[0]), Pack(0.0));
}

/// Velocity gradients of the bonds of point i, into the stress workspace.
void bond_gradients(const Model& model, const std::vector<PointKinematics>& points, std::size_t i,
                    const FamilyView& family, Workspace& w)
{
    for (std::size_t p = 0; p < family.packs; ++p) {
        const BondGeometry g = geometry(w, p * pack_width);
        const std::uint8_t active = model.bonds.active[family.first_pack + p];
        const auto other = gather_point<9>(points, family.neighbours + p * pack_width,
                                           [](const PointKinematics& k) { return components(k.gradient); });
        const std::array<double, 9> own = components(points[i].gradient);
        std::array<Pack, 9> l;
        for (std::size_t c = 0; c < 9; ++c)
            l[c] = 0.5 * (own[c] + other[c]);
        const Pack rest[3] = {g.u - (l[0] * g.x + l[1] * g.y + l[2] * g.z),
                              g.v - (l[3] * g.x + l[4] * g.y + l[5] * g.z),
                              g.t - (l[6] * g.x + l[7] * g.y + l[8] * g.z)};
        const PackMask mask = lane_mask(active);
        double* rows = w.gradient.data() + p * 9 * pack_width;
        for (std::size_t r = 0; r < 3; ++r) {
            std::size_t c = 3 * r;
            for (const Pack* n : {&g.nx, &g.ny, &g.nz}) {
                store_pack(select(mask, l[c] + rest[r] * *n, Pack(0.0)), rows + c * pack_width);
                ++c;
            }
        }
    }
}

/// A_i, and sigma_ij zeta/|zeta|^2 S_ij left in the rows of the force state.
Tensor<double> stress_sums(Model& model, const std::vector<PointKinematics>& points, std::size_t i,
                           const FamilyView& family, const Workspace& w, const BondStress& bs, Pack& work, Pack& dil)
{
    Tensor<Pack> sum;
    for (std::size_t p = 0; p < family.packs; ++p) {
        const BondGeometry g = geometry(w, p * pack_width);
        const auto out = bs.end(p);
        const SymmetricTensor<Pack>& stress = out.stress;
        const Pack sh = select(lane_mask(bs.active(p)), g.omega * g.volume * points[i].reciprocal_weight, Pack(0.0));
        work += sh * out.work;
        dil += sh * out.dilation;
        const Pack weight = mutual_weight(points, i, family.neighbours + p * pack_width, g.omega, w.stress.lanes[p]);
        const Pack tx = stress.xx * g.nx + stress.xy * g.ny + stress.xz * g.nz;
        const Pack ty = stress.xy * g.nx + stress.yy * g.ny + stress.yz * g.nz;
        const Pack tz = stress.xz * g.nx + stress.yz * g.ny + stress.zz * g.nz;
        double* rows = model.at_places.data() + (family.first_pack + p) * 3 * pack_width;
        store_pack(weight * tx, rows);
        store_pack(weight * ty, rows + pack_width);
        store_pack(weight * tz, rows + 2 * pack_width);
        const Pack half = 0.5 * g.volume * weight;
        sum += Tensor<Pack>{stress.xx - tx * g.x, stress.xy - tx * g.y, stress.xz - tx * g.z,
                            stress.xy - ty * g.x, stress.yy - ty * g.y, stress.yz - ty * g.z,
                            stress.xz - tz * g.x, stress.yz - tz * g.y, stress.zz - tz * g.z} *
               half;
    }
    return {reduce(sum.xx), reduce(sum.xy), reduce(sum.xz), reduce(sum.yx), reduce(sum.yy),
            reduce(sum.yz), reduce(sum.zx), reduce(sum.zy), reduce(sum.zz)};
}

/// V_i sum_j V_j (T_ij - T_ji), which is V_i sum_j V_j [S sigma + omega (A_i K_i^-1 + A_j K_j^-1)] zeta/|zeta|^2.
Vector3 internal_force(const Model& model, const std::vector<PointKinematics>& points, std::size_t i,
                       const FamilyView& family, const Workspace& w)
{
    Pack force[3] = {0.0, 0.0, 0.0};
    const std::array<double, 9> own = components(points[i].moment);
    for (std::size_t p = 0; p < family.packs; ++p) {
        const BondGeometry g = geometry(w, p * pack_width);
        const auto other = gather_point<9>(points, family.neighbours + p * pack_width,
                                           [](const PointKinematics& k) { return components(k.moment); });
        const double* rows = model.at_places.data() + (family.first_pack + p) * 3 * pack_width;
        for (std::size_t r = 0; r < 3; ++r)
            force[r] +=
                g.volume * (load_pack(rows + r * pack_width) +
                            g.omega * ((own[3 * r] + other[3 * r]) * g.nx + (own[3 * r + 1] + other[3 * r + 1]) * g.ny +
                                       (own[3 * r + 2] + other[3 * r + 2]) * g.nz));
    }
    return model.points.volume[i] * Vector3(reduce(force[0]), reduce(force[1]), reduce(force[2]));
}

/// Copies the kinematics of the parents to their images.
void update_images(const Model& model, std::vector<PointKinematics>& points)
{
    const std::size_t n = model.size();
    const std::vector<Image>& images = model.families.images();
#pragma omp parallel for schedule(static)
    for (std::size_t m = 0; m < images.size(); ++m) {
        const Isometry& isometry = model.isometries[images[m].isometry];
        const PointKinematics& parent = points[images[m].parent];
        PointKinematics& image = points[n + m];
        image.sound = parent.sound;
        image.reciprocal_weight = parent.reciprocal_weight;
        image.gradient = in_frame_of(isometry, parent.gradient);
        image.moment = in_frame_of(isometry, parent.moment);
    }
}

} // namespace

void BondProjectionForceState::evaluate(Model& model, const Evaluation& evaluation) const
{
    const std::size_t n = model.size();
    FirstFailure failure;
    model.at_places.resize(model.families.packs() * 3 * pack_width);
    std::vector<PointKinematics> points(n + model.families.images().size());
    for_every_family(model, influence(), [&](std::size_t i, const FamilyView& family, Workspace& w) {
        points[i] = point_kinematics(family, w);
    });
    update_images(model, points);
#pragma omp parallel for schedule(dynamic, 32)
    for (std::size_t i = 0; i < n; ++i)
        points[i].reciprocal_weight = find_activity(model, points, i, influence());
    update_images(model, points);
    for_every_family(model, influence(), [&](std::size_t i, const FamilyView& family, Workspace& w) {
        bond_gradients(model, points, i, family, w);
        BondStress stress(model, i, family.neighbours, family.packs, model.bonds.state.data() + model.bonds.first[i],
                          evaluation, w.stress);
        for (std::size_t p = 0; p < family.packs; ++p) {
            const double* g = w.gradient.data() + p * 9 * pack_width;
            const auto row = [&](std::size_t c) { return load_pack(g + c * pack_width); };
            stress.begin(
                p,
                at_mid_step(Tensor<Pack>{row(0), row(1), row(2), row(3), row(4), row(5), row(6), row(7), row(8)},
                            2.0 * evaluation.gradient_lag()),
                model.bonds.active[family.first_pack + p]);
        }
        const MaterialStatus status = stress.update();
        if (!status.converged)
            failure.report(i, status);
        Pack work = 0.0, dil = 0.0;
        points[i].moment = stress_sums(model, points, i, family, w, stress, work, dil) * points[i].inverse_shape;
        model.stress_work[i] = model.points.volume[i] * reduce(work);
        model.volume_rate[i] = reduce(dil);
    });
    failure.raise(model);
    update_images(model, points);
    for_every_family(model, influence(), [&](std::size_t i, const FamilyView& family, Workspace& w) {
        model.internal_force[i] = internal_force(model, points, i, family, w);
    });
}

void BondProjectionForceState::shares(const Model& model, std::size_t point, std::span<double> shares) const
{
    const FamilyView family = model.families[point];
    const NeighbourRecord& self = model.records[point];
    double total = 0.0;
    for (std::size_t b = 0; b < family.packs * pack_width; ++b) {
        const NeighbourRecord& other = model.records[family.neighbours[b]];
        double squared = 0.0;
        for (std::size_t c = 0; c < 3; ++c)
            squared += (other.position[c] - self.position[c]) * (other.position[c] - self.position[c]);
        const bool active = (model.bonds.active[family.first_pack + b / pack_width] >> b % pack_width & 1u) != 0;
        total += shares[b] = active ? influence()(squared) * other.volume : 0.0;
    }
    if (total > 0.0)
        for (double& share : shares)
            share /= total;
}

} // namespace periporo
