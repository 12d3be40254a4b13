#include "vda-sim/VehicleSpec.hpp"

#include <acs/vda5050/Topic.hpp>

#include <set>

namespace ACS::VdaSim
{
namespace
{

/// Cuts the text before the next comma off the front.
std::string_view TakePart(std::string_view& text)
{
    const std::size_t end = text.find(',');
    const std::string_view part = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    return part;
}

Core::Result<void> ReadPart(std::string_view part, VehicleSpec& spec, std::set<std::string_view>& known)
{
    const std::size_t equals = part.find('=');
    const std::string_view key = part.substr(0, equals);
    if (!known.insert(key).second)
    {
        return Core::Fail(Core::ECoreError::UnknownWord, {}, "each of type and node once", Core::QuoteForError(part));
    }
    const std::string_view value = equals == std::string_view::npos ? std::string_view{} : part.substr(equals + 1);
    if (key == "type" && (value == "LR" || value == "CR"))
    {
        spec.type = value == "LR" ? EVehicleType::Logistics : EVehicleType::Control;
        return {};
    }
    if (key == "type")
    {
        return Core::Fail(Core::ECoreError::UnknownWord, "type", "LR or CR", Core::QuoteForError(value));
    }
    if (key == "node" && !value.empty())
    {
        spec.startNodeID = std::string(value);
        return {};
    }
    return Core::Fail(Core::ECoreError::UnknownWord, {}, "type=LR|CR or node=NODEID", Core::QuoteForError(part));
}

} // namespace

Core::Result<VehicleSpec> ParseVehicleSpec(std::string_view text)
{
    VehicleSpec spec;
    spec.name = std::string(TakePart(text));
    const VDA5050::VehicleAddress address{.interfaceName = "x", .manufacturer = "x", .serialNumber = spec.name};
    if (!VDA5050::IsValidAddress(address))
    {
        return Core::Fail(
            Core::ECoreError::InvalidIdentifier,
            {},
            "NAME[,type=LR|CR][,node=NODEID], NAME without /, + and #",
            Core::QuoteForError(spec.name));
    }
    std::set<std::string_view> known;
    while (!text.empty())
    {
        const Core::Result<void> part = ReadPart(TakePart(text), spec, known);
        if (!part.has_value())
        {
            return tl::make_unexpected(part.error());
        }
    }
    return spec;
}

std::string_view GetTypeText(EVehicleType type)
{
    return type == EVehicleType::Control ? "CR" : "LR";
}

} // namespace ACS::VdaSim
