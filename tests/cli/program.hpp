// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs the real program in a folder of its own and looks at what it says and leaves behind.
#pragma once

#include "support/case_text.hpp"
#include "support/temporary_folder.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace periporo::test {

struct ProgramResult {
    int status = -1; ///< exit status; -1 when the program was ended by a signal
    std::string out;
    std::string error;
};

/// A folder that the program is run in.
class ProgramFolder {
public:
    const std::filesystem::path& path() const { return folder_.path(); }

    void write(const std::string& name, const std::string& text) const { write_file(folder_ / name, text); }

    /// @param arguments as typed in a shell.
    /// @param environment settings that are typed before the program
    ProgramResult run(const std::string& arguments, const std::string& environment = "") const
    {
        const std::filesystem::path out = captured_ / "out";
        const std::filesystem::path error = captured_ / "error";
        const std::string command = "cd '" + folder_.path().string() + "' && " + environment +
                                    " '" PERIPORO_PROGRAM "' " + arguments + " > '" + out.string() + "' 2> '" +
                                    error.string() + "'";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(out), read(error)};
    }

    /// Names of all there is in the folder.
    std::set<std::string> entries() const
    {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
            names.insert(entry.path().filename().string());
        return names;
    }

    static std::string read(const std::filesystem::path& file)
    {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

private:
    TemporaryFolder folder_;
    TemporaryFolder captured_;
};

/// A case of 4 x 4 x 4 points that the shipped plugins run in a moment.
inline const std::string small_case = R"(title = "a block that falls for a moment"
[discretization]
spacing = "25 mm"
[material.rubber]
model = "linear_elastic"
grain_density = "2000 kg/m3"
porosity = 0.2
bulk_modulus = "1 MPa"
shear_modulus = "0.5 MPa"
[body.block]
geometry = { generator = "box", size = ["100 mm", "100 mm", "100 mm"] }
material = "rubber"
[[contact]]
law = "rigid_plane"
between = ["block"]
point = [0, 0, "-1 m"]
normal = [0, 0, 1]
modulus = "1 MPa"
friction = 0.5
[[stage]]
name = "fall"
type = "dynamic"
duration = "1 ms"
[[output]]
writer = "hdf5"
every = "1 ms"
[[output]]
writer = "csv"
every = "1 ms"
)";

} // namespace periporo::test
