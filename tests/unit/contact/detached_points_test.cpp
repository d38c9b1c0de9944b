// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Contact of detached points: no energy appears where a point detaches or bonds again.
#include "contact/contact_forces.hpp"
#include "contact/short_range/short_range.hpp"
#include "support/specimens.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

using namespace periporo;

namespace {

const double spacing = 1e-2; // the law reaches 0.8 of it

struct Row {
    /// In a row.
    explicit Row(const std::vector<double>& places) : Row(positions(places)) {}
    explicit Row(const std::vector<Vector3>& places)
        : model(specimens::from_positions(places, spacing)), contact({{short_range(), {0, 0}}})
    {
        find_first_families(model,
                            *make_force_state("energy_conjugate", Influence::by_name("constant", model.state.horizon)));
    }

    static std::vector<Vector3> positions(const std::vector<double>& places)
    {
        std::vector<Vector3> result;
        for (const double place : places)
            result.push_back({place * spacing, 0.0, 0.0});
        return result;
    }

    static std::shared_ptr<const Contact> short_range()
    {
        Parameters parameters;
        parameters.set("modulus", 4e6);
        parameters.set("friction", 0.0);
        parameters.set("restitution", 1.0);
        auto law = std::make_shared<ShortRange>(parameters);
        law->scale({spacing, 3.015 * spacing});
        return law;
    }

    /// Energy of the contacts of points at `places` [spacings], of which some are detached [J].
    double energy(const std::vector<double>& places, const std::vector<std::uint8_t>& detached)
    {
        return energy(positions(places), detached);
    }
    double energy(const std::vector<Vector3>& places, const std::vector<std::uint8_t>& detached)
    {
        model.state.points.position = places;
        model.result.detached = detached;
        model.gather_ends();
        std::vector<Vector3> force(model.size(), Vector3::Zero());
        contact.add_reactions(model, 1e-5, ContactForces::Approach::none, force);
        return contact.energy();
    }

    Model model;
    ContactForces contact;
};

} // namespace

TEST_CASE("a point that detaches has the reach to its nearest neighbour, and no energy")
{
    Row grains({0.0, 0.5, 1.0});
    CHECK(grains.energy({0.0, 0.5, 1.0}, {0, 0, 0}) == 0.0);
    CHECK(grains.energy({0.0, 0.5, 1.0}, {0, 1, 0}) == 0.0);
    CHECK(grains.energy({0.0, 0.4, 1.0}, {0, 1, 0}) > 0.0);
    // once apart, it fills the whole reach of the law
    CHECK(grains.energy({-1.0, 0.4, 2.0}, {0, 1, 0}) == 0.0);
    CHECK(grains.energy({-0.3, 0.4, 2.0}, {0, 1, 0}) > 0.0);
}

TEST_CASE("a point that bonds again keeps its reach against detached points until they part")
{
    Row grains({0.0, 0.8, 1.3});
    // the first grain has the whole reach, the second that of the third beside it
    CHECK(grains.energy({0.0, 0.8, 1.3}, {1, 1, 1}) == 0.0);
    CHECK(grains.energy({0.15, 0.8, 1.3}, {1, 1, 1}) == 0.0);
    CHECK(grains.energy({0.15, 0.8, 1.3}, {1, 0, 0}) == 0.0);
    CHECK(grains.energy({0.15, 0.8, 1.3}, {1, 1, 0}) == 0.0);
    CHECK(grains.energy({0.15, 0.8, 1.3}, {1, 0, 0}) == 0.0);
    CHECK(grains.energy({0.0, 0.8, 1.6}, {1, 0, 0}) == 0.0);
    CHECK(grains.energy({0.15, 0.8, 1.6}, {1, 0, 0}) > 0.0);
}

TEST_CASE("the bounds of points cover the contacts of detached points, also where many touch, and not by much")
{
    struct Heap {
        double apart;  // [spacings]
        double jitter; // [of that]
        double excess; // of the bound, at most
    };
    for (const Heap& heap : {Heap{0.75, 0.0, 1.15}, Heap{0.75, 0.2, 2.0}, Heap{0.6, 0.3, 2.2}}) {
        CAPTURE(heap.apart);
        CAPTURE(heap.jitter);
        const std::vector<Vector3> places =
            specimens::jittered(specimens::lattice(5, 5, 5, heap.apart * spacing), heap.apart * spacing, heap.jitter);
        std::vector<Vector3> far = places;
        for (Vector3& x : far)
            x *= 3.0;
        Row grains(places);
        const std::vector<std::uint8_t> all_detached(places.size(), 1);
        grains.energy(far, all_detached); // each has the whole reach of the law now
        grains.energy(places, all_detached);

        const auto law = Row::short_range();
        const double v = grains.model.state.points.volume[0];
        const double m = grains.model.state.points.mass[0];
        const ContactPair pair{0.0, 0.0, v, v, m, m};
        ContactResponse response;
        law->evaluate({&pair, 1}, {&response, 1});
        const auto n = static_cast<Eigen::Index>(places.size());
        Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(3 * n, 3 * n);
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index j = 0; j < n; ++j) {
                const Vector3 apart = places[static_cast<std::size_t>(i)] - places[static_cast<std::size_t>(j)];
                if (i == j || apart.norm() >= law->cutoff())
                    continue;
                const Eigen::Matrix3d push = response.stiffness / m * apart * apart.transpose() / apart.squaredNorm();
                stiffness.block<3, 3>(3 * i, 3 * i) += push;
                stiffness.block<3, 3>(3 * i, 3 * j) -= push;
            }
        Eigen::MatrixXd bounds = Eigen::MatrixXd::Zero(3 * n, 3 * n);
        for (Eigen::Index i = 0; i < n; ++i)
            bounds.block<3, 3>(3 * i, 3 * i) =
                grains.contact.bounds(grains.model)[static_cast<std::size_t>(i)].stiffness;
        const auto largest = [](const Eigen::MatrixXd& matrix) {
            return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
                .eigenvalues()
                .maxCoeff();
        };
        CHECK(largest(stiffness - bounds) < 1e-9 * largest(stiffness));
        CHECK(largest(bounds) <= heap.excess * largest(stiffness));
    }
}
