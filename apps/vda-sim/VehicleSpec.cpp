#include "vda-sim/VehicleSpec.hpp"

#include <acs/core/ParseNumber.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

/// Prefixes the error's path with the vehicle's name: "LR01: ports".
tl::unexpected<Core::Error> RefuseVehicle(const std::string& name, Core::Error error)
{
    error.path = error.path.empty() ? name : fmt::format("{}: {}", name, error.path);
    return tl::make_unexpected(std::move(error));
}

/// Cuts the text before the next comma off the front.
std::string_view TakePart(std::string_view& text)
{
    const std::size_t end = text.find(',');
    const std::string_view part = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    return part;
}

template <typename TValue, typename TTarget>
Core::Result<void> Store(Core::Result<TValue> value, TTarget& target)
{
    if (!value.has_value())
    {
        return tl::make_unexpected(std::move(value.error()));
    }
    target = std::move(*value);
    return {};
}

Core::Result<double> ParsePercent(std::string_view text)
{
    constexpr double FULL = 100.0;
    const std::optional<double> percent = Core::ParseNumberOrNull<double>(text);
    if (!percent.has_value() || !(*percent >= 0.0 && *percent <= FULL))
    {
        return Core::Fail(Core::ECoreError::OutOfRange, "battery", "a number from 0 to 100", Core::QuoteForError(text));
    }
    return *percent;
}

Core::Result<StartPosition> ParsePosition(std::string_view text)
{
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::optional<double> x = Core::ParseNumberOrNull<double>(text.substr(0, colon));
    const std::optional<double> y = Core::ParseNumberOrNull<double>(text.substr(std::min(colon + 1, text.size())));
    if (!x.has_value() || !y.has_value() || !std::isfinite(*x) || !std::isfinite(*y))
    {
        return Core::Fail(Core::ECoreError::OutOfRange, "position", "X:Y in metres", Core::QuoteForError(text));
    }
    return StartPosition{*x, *y};
}

Core::Result<void> ReadPart(std::string_view part, VehicleSpec& spec, std::set<std::string_view>& known)
{
    const std::size_t equals = part.find('=');
    const std::string_view key = part.substr(0, equals);
    const bool bRepeatable = key == "load"; // once for each port
    if (!known.insert(key).second && !bRepeatable)
    {
        return Core::Fail(Core::ECoreError::UnknownWord, {}, "each key once", Core::QuoteForError(part));
    }
    const std::string_view value = equals == std::string_view::npos ? std::string_view{} : part.substr(equals + 1);
    if (key == "type")
    {
        return Store(ParseVehicleType(value), spec.type);
    }
    if (key == "protocol")
    {
        return Store(ParseProtocol(value), spec.version);
    }
    if (key == "profile")
    {
        return Store(ParseProfile(value), spec.profile);
    }
    if (key == "battery")
    {
        return Store(ParsePercent(value), spec.charge);
    }
    if (key == "position")
    {
        return Store(ParsePosition(value), spec.startPosition);
    }
    if (key == "node" && !value.empty())
    {
        spec.startNodeID = std::string(value);
        return {};
    }
    const Core::Result<bool> read = TryReadHandlingKey(key, value, spec.handling);
    if (!read.has_value())
    {
        return tl::make_unexpected(read.error());
    }
    if (!*read || equals == std::string_view::npos)
    {
        return Core::Fail(
            Core::ECoreError::UnknownWord,
            {},
            fmt::format(
                "type=LR|CR, node=NODEID, position=X:Y, protocol=VERSION, battery=PERCENT, profile=NAME, {}",
                LOAD_HANDLING_KEYS),
            Core::QuoteForError(part));
    }
    return {};
}

} // namespace

bool IsPlainLevel(std::string_view text)
{
    constexpr std::string_view MARKS = "/+#$";
    return !text.empty() && std::ranges::all_of(text, [MARKS](char letter) {
        return letter > ' ' && letter <= '~' && MARKS.find(letter) == std::string_view::npos;
    });
}

Core::Result<VehicleSpec> ParseVehicleSpec(std::string_view text)
{
    VehicleSpec spec;
    spec.name = std::string(TakePart(text));
    constexpr std::string_view COMMAND_MARKS = "*="; // of fault commands, which begin with a name
    if (!IsPlainLevel(spec.name) || spec.name.find_first_of(COMMAND_MARKS) != std::string::npos)
    {
        return Core::Fail(
            Core::ECoreError::InvalidIdentifier,
            {},
            "NAME[,type=LR|CR][,node=NODEID][,position=X:Y][,protocol=VERSION][,battery=PERCENT][,profile=NAME], NAME without blanks, /, +, "
            "#, $, * and =",
            Core::QuoteForError(spec.name));
    }
    std::set<std::string_view> known;
    while (!text.empty())
    {
        const Core::Result<void> part = ReadPart(TakePart(text), spec, known);
        if (!part.has_value())
        {
            return RefuseVehicle(spec.name, part.error());
        }
    }
    const Core::Result<void> fits = CheckHandling(spec.type, spec.handling);
    if (!fits.has_value())
    {
        return RefuseVehicle(spec.name, fits.error());
    }
    return spec;
}

Core::Result<EVehicleType> ParseVehicleType(std::string_view text)
{
    for (const EVehicleType type : {EVehicleType::Logistics, EVehicleType::Control})
    {
        if (text == GetTypeText(type))
        {
            return type;
        }
    }
    return Core::Fail(Core::ECoreError::UnknownWord, "type", "LR or CR", Core::QuoteForError(text));
}

Core::Result<VDA5050::EVda5050Version> ParseProtocol(std::string_view text)
{
    for (const auto known : {VDA5050::EVda5050Version::Version200, VDA5050::EVda5050Version::Version210})
    {
        if (text == VDA5050::GetVersionText(known))
        {
            return known;
        }
    }
    return Core::Fail(Core::ECoreError::UnknownWord, "protocol", "2.0.0 or 2.1.0", Core::QuoteForError(text));
}

std::string MakeVehicleName(std::string_view prefix, std::size_t number, std::size_t count)
{
    constexpr std::size_t MIN_DIGITS = 2;
    return fmt::format("{}{:0{}}", prefix, number, std::max(MIN_DIGITS, std::to_string(count).size()));
}

std::string_view GetTypeText(EVehicleType type)
{
    return type == EVehicleType::Control ? "CR" : "LR";
}

} // namespace ACS::VdaSim
