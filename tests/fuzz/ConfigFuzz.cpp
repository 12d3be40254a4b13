#include "common/config/ConfigReader.hpp"
#include "FuzzCheck.hpp"

#include <chrono>
#include <string>

namespace
{

using namespace ACS; // NOLINT(google-build-using-namespace)

void ReadTable(const Apps::ConfigSection& section, int depth)
{
    constexpr int MOST_TABLES = 4;
    constexpr double MIN = -1e9;
    constexpr double MAX = 1e9;
    using namespace std::chrono_literals;
    for (const std::string& name : section.GetNames())
    {
        switch (name.size() % 8)
        {
            case 0:
                static_cast<void>(section.GetString(name));
                break;
            case 1:
                Fuzz::Require(section.GetInteger(name, 0, 100, 1) <= 100, "an integer is within its limits");
                break;
            case 2:
                Fuzz::Require(section.GetNumber(name, MIN, MAX, 1.0) <= MAX, "a number is within its limits");
                break;
            case 3:
                Fuzz::Require(section.GetDuration(name, 1s, 1h, 2s) >= 1s, "a duration is within its limits");
                break;
            case 4:
                static_cast<void>(section.GetEndpoint(name, {}));
                break;
            case 5:
                static_cast<void>(section.GetURL(name, {Apps::EUrlScheme::Ws, Apps::EUrlScheme::Mqtts}));
                break;
            case 6:
                static_cast<void>(section.GetStringList(name));
                break;
            default:
                if (depth < MOST_TABLES)
                {
                    ReadTable(section.GetSection(name), depth + 1);
                }
                break;
        }
    }
}

} // namespace

/// A configuration; what follows a NUL is an override.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = Fuzz::AsText(data, size);
    const std::size_t end = text.find('\0');
    std::vector<std::string> overrides;
    if (end != std::string_view::npos)
    {
        overrides.emplace_back(text.substr(end + 1));
    }
    const Apps::ConfigReader reader = Apps::ConfigReader::ReadText(text.substr(0, end), "fuzz.toml", overrides);
    ReadTable(reader.GetRoot(), 0);
    for (const std::string& error : reader.GetErrors())
    {
        Fuzz::Require(error.find('\n') == std::string::npos, "an error is one line");
    }
    static_cast<void>(reader.GetValues());
    return 0;
}
