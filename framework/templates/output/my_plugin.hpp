// my plugin: writes where the highest point is, one row of my_plugin.csv for each snapshot.
//
// Make it yours: what is written in snapshot() and history(), and the parameters.
#pragma once

#include <periporo/output.hpp>

#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace lab {

using namespace periporo;

class MyPlugin : public periporo::OutputWriter {
public:
    /// What a case gives. Values arrive checked and in SI units; `periporo inspect my_plugin` prints this list.
    static std::vector<Parameter> parameters()
    {
        return {
            Parameter::integer("digits", "Significant digits of the numbers").at_least(1).at_most(17).by_default(9)};
    }

    explicit MyPlugin(const Parameters& parameters) : digits_(parameters.integer("digits")) {}

    /// A run that is resumed keeps the rows up to its checkpoint; those after it are computed again.
    void begin(const RunDescription& run) override
    {
        file_ = run.directory / "my_plugin.csv";
        const std::string kept = run.resumed ? rows_until(run.resumed_step) : "";
        stream_.open(file_, std::ios::trunc);
        stream_.precision(digits_);
        stream_ << header << kept;
        flush();
    }

    void snapshot(const Snapshot& snapshot) override
    {
        const std::span<const double> x = snapshot.positions; // x, y, z point by point
        if (x.empty())
            return;
        std::size_t highest = 0;
        for (std::size_t i = 0; i < x.size(); i += 3)
            if (x[i + 2] > x[highest + 2])
                highest = i;
        stream_ << snapshot.step << ',' << snapshot.time;
        for (const double coordinate : x.subspan(highest, 3))
            stream_ << ',' << coordinate;
        stream_ << '\n';
    }

    void history(std::uint64_t, std::span<const double>) override {}

    /// Errors are exceptions that name the file.
    void flush() override
    {
        if (!stream_.flush())
            throw std::runtime_error("cannot write " + file_.string());
    }

    /// Also called when a run is interrupted: the file is complete either way.
    void finish(bool) override { flush(); }

private:
    static constexpr const char* header = "step,time [s],x [m],y [m],z [m]\n";

    /// The rows of the file whose step is not beyond the given one. A last line that a kill cut off is left out.
    std::string rows_until(std::uint64_t last_step) const
    {
        std::ifstream earlier(file_);
        std::string rows, line;
        std::getline(earlier, line); // the header
        while (std::getline(earlier, line) && !earlier.eof() && std::stoull(line) <= last_step)
            rows += line + '\n';
        return rows;
    }

    std::int64_t digits_;
    std::filesystem::path file_;
    std::ofstream stream_;
};

} // namespace lab
