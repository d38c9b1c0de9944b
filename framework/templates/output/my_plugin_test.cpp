// my plugin: what stands in the file, after a run and after one that was resumed.
#include "my_plugin.hpp"

#include <doctest/doctest.h>

#include <iterator>
#include <string>
#include <vector>

using namespace periporo;

namespace {

/// An empty folder under the current one, gone when the test ends.
class Folder {
public:
    Folder() { std::filesystem::remove_all(path), std::filesystem::create_directory(path); }
    ~Folder() { std::filesystem::remove_all(path); }

    const std::filesystem::path path = std::filesystem::current_path() / "my_plugin_test_folder";

    std::string text() const
    {
        std::ifstream stream(path / "my_plugin.csv");
        return {std::istreambuf_iterator<char>(stream), {}};
    }
};

lab::MyPlugin writer()
{
    Parameters parameters;
    parameters.set("digits", std::int64_t{9});
    return lab::MyPlugin(parameters);
}

/// A run into the folder, or the rest of one that goes on after a step.
RunDescription run_in(const Folder& folder, bool resumed = false, std::uint64_t step = 0)
{
    RunDescription run;
    run.directory = folder.path;
    run.resumed = resumed;
    run.resumed_step = step;
    return run;
}

/// Two points, of which the second is the higher.
void show(lab::MyPlugin& writer, std::uint64_t step, double height)
{
    const std::vector<double> positions{0.0, 0.0, 0.25, 1.0, 2.0, height};
    Snapshot snapshot;
    snapshot.step = step;
    snapshot.time = 0.5;
    snapshot.positions = positions;
    writer.snapshot(snapshot);
}

} // namespace

TEST_CASE("each snapshot is one row with the highest point")
{
    const Folder folder;
    lab::MyPlugin output = writer();
    output.begin(run_in(folder));
    show(output, 10, 3.0);
    show(output, 20, 2.75);
    output.finish(true);
    CHECK(folder.text() == "step,time [s],x [m],y [m],z [m]\n10,0.5,1,2,3\n20,0.5,1,2,2.75\n");
}

TEST_CASE("a resumed run keeps the rows up to its checkpoint")
{
    const Folder folder;
    {
        lab::MyPlugin killed = writer();
        killed.begin(run_in(folder));
        show(killed, 10, 3.0);
        show(killed, 20, 2.75);
        killed.flush(20);
    }
    lab::MyPlugin output = writer();
    output.begin(run_in(folder, true, 10));
    show(output, 30, 2.5);
    output.finish(true);
    CHECK(folder.text() == "step,time [s],x [m],y [m],z [m]\n10,0.5,1,2,3\n30,0.5,1,2,2.5\n");
}

TEST_CASE("a folder that is not there is an error that names the file")
{
    RunDescription run;
    run.directory = "no such folder";
    lab::MyPlugin output = writer();
    CHECK_THROWS_WITH(output.begin(run), doctest::Contains("my_plugin.csv"));
}
