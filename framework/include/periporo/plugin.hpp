// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How a shared library says what it provides. A plugin source ends with one line:
//
//     PERIPORO_PLUGIN(periporo::PluginKind::geometry, my_lab::Sphere, "sphere", "A ball")
//
// where Sphere derives from the interface of its kind, has `static std::vector<Parameter> parameters()` and is
// constructed from `const Parameters&`.
#pragma once

#include "periporo/parameters.hpp"
#include "periporo/target.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace periporo {

enum class PluginKind : std::uint32_t { geometry = 1, material, contact, retention, output };

/// "geometry", "material", ...
const char* kind_name(PluginKind kind);

/// First four bytes of every descriptor, "ppor".
inline constexpr std::uint32_t plugin_magic = 0x70706f72;
/// Raised whenever an interface of the SDK changes its meaning or layout.
inline constexpr std::uint32_t plugin_api_version = 8;
/// The one symbol a plugin exports.
inline constexpr const char* plugin_symbol = "periporo_plugin";

class Geometry;
class Material;
class Contact;
class Retention;
class OutputWriter;

/// What a plugin library is and how to make its objects: plain data, so that a loader built by another compiler can
/// still read and refuse it. The first four members never change place.
struct PluginDescriptor {
    std::uint32_t magic;
    std::uint32_t api_version;
    std::uint32_t size;      ///< sizeof(PluginDescriptor) at the plugin's compile time
    std::uint32_t alignment; ///< alignof(PluginDescriptor)
    const char* fingerprint; ///< compiler, standard, library ABI, Eigen alignment and pack width
    PluginKind kind;
    const char* name;
    const char* summary;
    /// Appends the parameter records.
    void (*parameters)(std::vector<Parameter>& records);
    /// Makes an object of the interface of `kind`, as a pointer to that interface; null and a filled `error` when the
    /// constructor threw.
    void* (*create)(const Parameters& parameters, std::string& error);
};

/// What must agree between a plugin and the program, in words. Each translation unit has its own copy on purpose: a
/// shared symbol would be resolved to the program's.
namespace {
[[maybe_unused]] constexpr auto abi_fingerprint = [] { // NOLINT(misc-definitions-in-headers)
    std::array<char, 96> text{};
    std::size_t length = 0;
    const auto add = [&](const char* part) {
        for (; *part != '\0'; ++part)
            text[length++] = *part;
    };
    const auto add_number = [&](long number) {
        std::array<char, 20> digits{};
        std::size_t count = 0;
        do
            digits[count++] = static_cast<char>('0' + number % 10);
        while ((number /= 10) > 0);
        while (count > 0)
            text[length++] = digits[--count];
    };
#if defined(__clang__)
    add("clang ");
    add_number(__clang_major__);
#else
    add("gcc ");
    add_number(__GNUC__);
#endif
    add(", C++");
    add_number(__cplusplus / 100 % 100);
    add(", libstdc++ ABI ");
    add_number(_GLIBCXX_USE_CXX11_ABI);
    add(", Eigen alignment ");
    add_number(static_cast<long>(eigen_alignment));
    add(", pack width ");
    add_number(static_cast<long>(pack_width));
    return text;
}();
} // namespace

/// The interface class of each kind.
template <PluginKind kind>
struct InterfaceOf;
template <>
struct InterfaceOf<PluginKind::geometry> {
    using type = Geometry;
};
template <>
struct InterfaceOf<PluginKind::material> {
    using type = Material;
};
template <>
struct InterfaceOf<PluginKind::contact> {
    using type = Contact;
};
template <>
struct InterfaceOf<PluginKind::retention> {
    using type = Retention;
};
template <>
struct InterfaceOf<PluginKind::output> {
    using type = OutputWriter;
};

/// The descriptor of a plugin class; exceptions of its constructor end here and become the text of `error`.
template <PluginKind kind, class Implementation>
PluginDescriptor describe_plugin(const char* name, const char* summary)
{
    using Interface = typename InterfaceOf<kind>::type;
    static_assert(std::is_base_of_v<Interface, Implementation>, "the class must derive from the interface of its kind");
    return {plugin_magic,
            plugin_api_version,
            sizeof(PluginDescriptor),
            alignof(PluginDescriptor),
            abi_fingerprint.data(),
            kind,
            name,
            summary,
            [](std::vector<Parameter>& records) {
                for (Parameter& record : Implementation::parameters())
                    records.push_back(std::move(record));
            },
            [](const Parameters& parameters, std::string& error) -> void* {
                try {
                    return static_cast<Interface*>(new Implementation(parameters));
                } catch (const std::exception& exception) {
                    error = exception.what();
                } catch (...) {
                    error = "an exception that is not derived from std::exception";
                }
                return nullptr;
            }};
}

} // namespace periporo

/// Registers a class as the plugin of this library; see the top of this file. A macro because the entry point must be
/// one exported C symbol.
#define PERIPORO_PLUGIN(kind, implementation, name, summary)                                                           \
    extern "C" __attribute__((visibility("default"))) const ::periporo::PluginDescriptor* periporo_plugin()            \
    {                                                                                                                  \
        static const ::periporo::PluginDescriptor descriptor =                                                         \
            ::periporo::describe_plugin<kind, implementation>(name, summary);                                          \
        return &descriptor;                                                                                            \
    }
