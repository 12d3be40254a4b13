#include "LoadOptions.hpp"

#include <fmt/format.h>

namespace ACS::Load
{

void AddLoadOptions(CLI::App& app, LoadOptions& options, const char* example, std::size_t fewest, std::size_t most)
{
    app.add_option("--robots", options.robots, fmt::format("Numbers of robots, a row each, for example {}", example))
        ->delimiter(',')
        ->check(CLI::Range(fewest, most))
        ->capture_default_str();
    app.add_option("--seconds", options.seconds, "Measuring time of each row in seconds")
        ->check(CLI::Range(1, 100'000))
        ->capture_default_str();
    app.add_flag("--counts-only", options.bCountsOnly, "Show the bounds, but do not fail if a value is out of them");
}

} // namespace ACS::Load
