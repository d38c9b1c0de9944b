// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The utility routines, under the names that Fortran compilers give them.
//
// Source of interfaces and definitions: Abaqus User Subroutines Reference Guide, part "Utility routines".
#include "utility_routines.hpp"

#include "side_stack.hpp"

#include <dlfcn.h>

#include <Eigen/Eigenvalues>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace periporo::abaqus {

namespace {

using Eigen::Matrix3d;

thread_local std::string error_text;

/// Where the shear components stand: 12, 13, 23 in Abaqus/Standard and 12, 23, 13 in Abaqus/Explicit.
using ShearOrder = int[3][2];
constexpr ShearOrder standard_order = {{0, 1}, {0, 2}, {1, 2}};
constexpr ShearOrder explicit_order = {{0, 1}, {1, 2}, {0, 2}};

/// The full tensor; component n stands at components[n * stride], missing ones are zero.
/// @param shear_factor 1 for tensor components, 1/2 for engineering shear
Matrix3d full_tensor(const double* components, int stride, int direct, int shear, const ShearOrder& order,
                     double shear_factor)
{
    Matrix3d tensor = Matrix3d::Zero();
    for (int i = 0; i < std::min(direct, 3); ++i)
        tensor(i, i) = components[i * stride];
    for (int n = 0; n < std::min(shear, 3); ++n) {
        const auto [i, j] = order[n];
        tensor(i, j) = tensor(j, i) = shear_factor * components[(direct + n) * stride];
    }
    return tensor;
}

/// LSTR = 2 marks strains, whose shear components are engineering ones.
double shear_factor(int lstr)
{
    return lstr == 2 ? 0.5 : 1.0;
}

std::string_view trimmed(const char* text, std::size_t length)
{
    std::string_view view(text, length);
    view = view.substr(0, view.find('\0'));
    return view.substr(0, view.find_last_not_of(' ') + 1);
}

/// The text with %I, %R and %S replaced by the next integer, real and text of eight characters.
std::string filled_in(std::string_view text, const int* integers, const double* reals, const char* texts)
{
    std::string result;
    for (std::size_t n = 0; n < text.size(); ++n) {
        const char kind = text[n] == '%' && n + 1 < text.size() ? text[n + 1] : '\0';
        if (kind == 'I' || kind == 'i')
            result += fmt::format("{}", *integers++);
        else if (kind == 'R' || kind == 'r')
            result += fmt::format("{:g}", *reals++);
        else if (kind == 'S' || kind == 's')
            result += trimmed(texts, 8), texts += 8;
        else {
            result += text[n];
            continue;
        }
        ++n;
    }
    return result;
}

void print(const char* level, const std::string& text)
{
    static std::atomic<int> left = 20; // a routine may warn at every bond of every step
    if (const int n = left.fetch_sub(1); n > 0)
        std::fprintf(stderr, "user routine, %s: %s\n%s", level, text.c_str(),
                     n == 1 ? "further messages of user routines are not shown\n" : "");
}

/// Prints a message, or keeps it as the error of this thread.
/// @return whether the analysis is to end at once
bool report(int lop, const std::string& message)
{
    if (lop > -2)
        print(lop == -1 ? "warning" : "information", message);
    else
        error_text = message.empty() ? "no text" : message;
    return lop <= -3;
}

[[noreturn]] void exit_routine(const char* cause = "XIT or XPLB_EXIT")
{
    SideStack::leave();
    // a thread that the routine itself started: neither can it be returned to nor does anyone wait for it
    std::fprintf(stderr, "a user routine called %s in a thread of its own\n", cause);
    std::abort();
}

} // namespace

void share_utility_routines()
{
    // The program loads plugins so that they do not see each other's symbols; the few of this library are opened up.
    static const char here = 0;
    Dl_info self{};
    if (::dladdr(&here, &self) == 0 || ::dlopen(self.dli_fname, RTLD_NOW | RTLD_NOLOAD | RTLD_GLOBAL) == nullptr)
        throw std::runtime_error("the utility routines cannot be shared with the user's library");
}

void forget_reported_error()
{
    error_text.clear();
}

const std::string& reported_error()
{
    return error_text;
}

void leave_with_error(std::string text)
{
    error_text = std::move(text);
    exit_routine(error_text.c_str());
}

} // namespace periporo::abaqus

using namespace periporo::abaqus;

#pragma GCC visibility push(default)
extern "C" {

void xit_()
{
    exit_routine();
}

void xplb_exit_()
{
    exit_routine();
}

/// @param lop 1 information, -1 warning, -2 error, -3 error that ends the analysis at once
/// @param text_length hidden argument of Fortran; the interface allows 500 characters
void stdb_abqerr_(const int* lop, const char* text, const int* integers, const double* reals, const char* texts,
                  std::size_t text_length)
{
    const std::size_t length = std::min<std::size_t>(text_length, 500);
    // the text is gone before the routine stops
    if (report(*lop, filled_in(trimmed(text, length), integers, reals, texts)))
        exit_routine();
}

void xplb_abqerr_(const int* lop, const char* text, const int* integers, const double* reals, const char* texts,
                  std::size_t text_length)
{
    stdb_abqerr_(lop, text, integers, reals, texts, text_length);
}

/// tr(sigma)/3 and sqrt(3/2 S:S) with the deviator S.
void sinv_(const double* stress, double* mean, double* mises, const int* ndi, const int* nshr)
{
    const Matrix3d tensor = full_tensor(stress, 1, *ndi, *nshr, standard_order, 1.0);
    *mean = tensor.trace() / 3.0;
    *mises = std::sqrt(1.5) * (tensor - *mean * Matrix3d::Identity()).norm();
}

/// The three principal values, in rising order; the interface leaves their order open.
void sprinc_(const double* tensor, double* values, const int* lstr, const int* ndi, const int* nshr)
{
    const Matrix3d full = full_tensor(tensor, 1, *ndi, *nshr, standard_order, shear_factor(*lstr));
    Eigen::Map<Eigen::Vector3d>{values} =
        Eigen::SelfAdjointEigenSolver<Matrix3d>(full, Eigen::EigenvaluesOnly).eigenvalues();
}

/// Principal values and AN(k, i), the direction cosines of the direction of PS(k).
void sprind_(const double* tensor, double* values, double* directions, const int* lstr, const int* ndi, const int* nshr)
{
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(
        full_tensor(tensor, 1, *ndi, *nshr, standard_order, shear_factor(*lstr)));
    Eigen::Map<Eigen::Vector3d>{values} = solver.eigenvalues();
    Eigen::Map<Matrix3d>{directions} = solver.eigenvectors().transpose(); // both by columns
}

/// R S R^T.
void rotsig_(const double* tensor, const double* rotation, double* rotated, const int* lstr, const int* ndi,
             const int* nshr)
{
    const double factor = shear_factor(*lstr);
    const Eigen::Map<const Matrix3d> r(rotation);
    const Matrix3d full = r * full_tensor(tensor, 1, *ndi, *nshr, standard_order, factor) * r.transpose();
    for (int i = 0; i < std::min(*ndi, 3); ++i)
        rotated[i] = full(i, i);
    for (int n = 0; n < std::min(*nshr, 3); ++n)
        rotated[*ndi + n] = full(standard_order[n][0], standard_order[n][1]) / factor;
}

/// The three principal values of nblock tensors of tensor components, in rising order.
void vsprinc_(const int* nblock, const double* tensors, double* values, const int* ndir, const int* nshr)
{
    for (int k = 0; k < *nblock; ++k) {
        const Matrix3d full = full_tensor(tensors + k, *nblock, *ndir, *nshr, explicit_order, 1.0);
        const Eigen::Vector3d principal =
            Eigen::SelfAdjointEigenSolver<Matrix3d>(full, Eigen::EigenvaluesOnly).eigenvalues();
        for (int i = 0; i < 3; ++i)
            values[i * *nblock + k] = principal[i];
    }
}
}
#pragma GCC visibility pop
