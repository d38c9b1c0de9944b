// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Texts of errors and warnings with the place that a key has.
#include "case/refusal.hpp"

#include <fmt/format.h>

#include <new>

namespace periporo {
namespace {

std::string place_of(const CaseDescription& description, std::string key)
{
    while (true) {
        const auto found = description.places.find(key);
        if (found != description.places.end())
            return found->second;
        const std::size_t dot = key.rfind('.');
        if (dot == std::string::npos)
            return description.file.empty() ? "case" : description.file.string();
        key.resize(dot);
    }
}

} // namespace

CaseError refusal(const CaseDescription& description, const std::string& key, const std::string& message,
                  const std::string& hint)
{
    const std::string text = fmt::format("{}: error: {}\n{}", place_of(description, key), message,
                                         hint.empty() ? "" : fmt::format("  hint: {}\n", hint));
    return CaseError({{description.file, 0, 0, message, hint, {}}}, text);
}

void refuse_failures(const CaseDescription& description, const std::string& key, const std::function<void()>& work)
{
    try {
        work();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const CaseError&) {
        throw;
    } catch (const PluginError&) {
        throw;
    } catch (const std::exception& error) {
        throw refusal(description, key, error.what());
    }
}

bool Refusals::attempt(const std::string& key, const std::function<void()>& work)
{
    try {
        work();
        return true;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const CaseError& error) {
        keep(error);
    } catch (const std::exception& error) {
        keep(refusal(description_, key, error.what()));
    }
    return false;
}

void Refusals::keep(const CaseError& error)
{
    diagnostics_.insert(diagnostics_.end(), error.diagnostics().begin(), error.diagnostics().end());
    text_ += error.what();
}

void Refusals::raise() const
{
    if (!diagnostics_.empty())
        throw CaseError(diagnostics_, text_);
}

std::string suspicion(const CaseDescription& description, const std::string& key, const std::string& message)
{
    return fmt::format("{}: warning: {}", place_of(description, key), message);
}

} // namespace periporo
