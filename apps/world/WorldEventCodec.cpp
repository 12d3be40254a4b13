#include "world/WorldEventCodec.hpp"

#include "world/MemoryEnumNames.hpp"
#include <acs/json/TaggedVariant.hpp>
#include <acs/json/TextCodec.hpp>

#include <array>
#include <string_view>
#include <tuple>

namespace ACS::Json
{

template <>
struct JsonFields<Sim::RobotDocked>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robot", &Sim::RobotDocked::robotID),
        Required("stations", &Sim::RobotDocked::stationIDs));
};

template <>
struct JsonFields<Sim::CarrierMoved>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robot", &Sim::CarrierMoved::robotID),
        Required("carrier", &Sim::CarrierMoved::carrierID),
        Required("from", &Sim::CarrierMoved::from),
        Required("to", &Sim::CarrierMoved::to));
};

template <>
struct JsonFields<Sim::MemoryMoved>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robot", &Sim::MemoryMoved::robotID),
        Required("from", &Sim::MemoryMoved::from),
        Required("to", &Sim::MemoryMoved::to));
};

template <>
struct JsonFields<Sim::CoverMoved>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robot", &Sim::CoverMoved::robotID),
        Required("set", &Sim::CoverMoved::set),
        Required("closed", &Sim::CoverMoved::bClosed));
};

template <>
struct JsonFields<Sim::ButtonPushed>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("robot", &Sim::ButtonPushed::robotID), Required("place", &Sim::ButtonPushed::place));
};

template <>
struct JsonFields<Sim::CarrierPlaced>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("carrier", &Sim::CarrierPlaced::carrierID),
        Required("place", &Sim::CarrierPlaced::place));
};

template <>
struct JsonFields<Sim::MemoryPlaced>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("place", &Sim::MemoryPlaced::place), Required("memory", &Sim::MemoryPlaced::memory));
};

template <>
struct VariantTag<Sim::WorldEvent>
{
    static constexpr std::string_view NAME = "event";
    static constexpr std::array<std::string_view, 7> WORDS{
        "RobotDocked",
        "CarrierMoved",
        "MemoryMoved",
        "CoverMoved",
        "ButtonPushed",
        "CarrierPlaced",
        "MemoryPlaced"};
};

} // namespace ACS::Json

namespace ACS::Sim
{
namespace
{

constexpr Json::ParseLimits LINE_LIMITS{64U * 1024U, 4};

} // namespace

std::string EncodeWorldEvent(const WorldEvent& event)
{
    return Json::EncodeText(event);
}

Core::Result<WorldEvent> DecodeWorldEvent(std::string_view line)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root = document.Parse(line, LINE_LIMITS);
    if (!root.has_value())
    {
        return tl::make_unexpected(root.error());
    }
    Json::DecodeOptions options;
    options.bUnknownMembersRefused = true;
    options.bWordsInAnyCase = false;
    Json::DecodeContext context(options);
    WorldEvent event;
    if (!Json::TryDecode(**root, event, {}, context))
    {
        return tl::make_unexpected(context.TakeError());
    }
    return event;
}

} // namespace ACS::Sim
