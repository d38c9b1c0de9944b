// my plugin: writes where the highest point is, one row of my_plugin.csv for each snapshot.
//
// Make it yours: what is written in snapshot() and history(), and the parameters.
#pragma once

#include <periporo/file.hpp>
#include <periporo/output.hpp>

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <system_error>
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

    /// What `periporo run --overwrite` deletes.
    std::vector<std::string> files() const override { return {"my_plugin.csv"}; }

    /// A run that is resumed keeps the rows up to its checkpoint; those after it are computed again. The file is
    /// written aside and renamed, so that a kill leaves the old one or the new one.
    void begin(const RunDescription& run) override
    {
        file_ = run.directory / "my_plugin.csv";
        write_whole(file_, header + (run.resumed ? rows_until(run.resumed_step) : std::string()));
        rows_ = AppendedFile(file_);
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
        std::ostringstream row;
        row.precision(static_cast<int>(digits_));
        row << snapshot.step << ',' << snapshot.time;
        for (const double coordinate : x.subspan(highest, 3))
            row << ',' << coordinate;
        row << '\n';
        rows_.append(row.str()); // throws with the reason of the system, "No space left on device"
    }

    void history(std::uint64_t, std::span<const double>) override {}

    void flush(std::uint64_t) override { rows_.synchronize(); }

    /// Also called when a run is interrupted: the file is complete either way.
    void finish(bool) override { rows_.synchronize(); }

private:
    static constexpr const char* header = "step,time [s],x [m],y [m],z [m]\n";

    /// The rows of the file whose step is not beyond the given one. A last line that a kill cut off is left out, and so
    /// is everything from the first line on that is no row.
    std::string rows_until(std::uint64_t last_step) const
    {
        std::ifstream earlier(file_);
        std::string rows, line;
        std::getline(earlier, line); // the header
        while (std::getline(earlier, line) && !earlier.eof()) {
            std::uint64_t step = 0;
            const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), step);
            if (error != std::errc() || *end != ',' || step > last_step)
                break;
            rows += line + '\n';
        }
        return rows;
    }

    std::int64_t digits_;
    std::filesystem::path file_;
    AppendedFile rows_;
};

} // namespace lab
