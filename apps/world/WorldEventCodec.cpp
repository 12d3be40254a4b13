#include "world/WorldEventCodec.hpp"

#include "world/MemoryEnumNames.hpp"
#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/json/JsonEncoder.hpp>

#include <array>
#include <cstdint>
#include <tuple>
#include <variant>

namespace ACS::Sim
{
namespace
{

/// The kinds of events, in the order of the alternatives of WorldEvent.
enum class EWorldEvent : std::uint8_t
{
    RobotDocked,
    CarrierMoved,
    MemoryMoved,
    CoverMoved,
    ButtonPushed,
    CarrierPlaced,
    MemoryPlaced,
};

template <typename TEvent>
struct JournalLine
{
    EWorldEvent kind{};
    TEvent event{};
};

} // namespace
} // namespace ACS::Sim

namespace ACS::Json
{

template <>
struct EnumNames<Sim::EWorldEvent>
{
    static constexpr std::array WORDS{
        EnumWord<Sim::EWorldEvent>{Sim::EWorldEvent::RobotDocked, "RobotDocked"},
        EnumWord<Sim::EWorldEvent>{Sim::EWorldEvent::CarrierMoved, "CarrierMoved"},
        EnumWord<Sim::EWorldEvent>{Sim::EWorldEvent::MemoryMoved, "MemoryMoved"},
        EnumWord<Sim::EWorldEvent>{Sim::EWorldEvent::CoverMoved, "CoverMoved"},
        EnumWord<Sim::EWorldEvent>{Sim::EWorldEvent::ButtonPushed, "ButtonPushed"},
        EnumWord<Sim::EWorldEvent>{Sim::EWorldEvent::CarrierPlaced, "CarrierPlaced"},
        EnumWord<Sim::EWorldEvent>{Sim::EWorldEvent::MemoryPlaced, "MemoryPlaced"}};
};

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

template <typename TEvent>
struct JsonFields<Sim::JournalLine<TEvent>>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("event", &Sim::JournalLine<TEvent>::kind), Flat(&Sim::JournalLine<TEvent>::event));
};

} // namespace ACS::Json

namespace ACS::Sim
{
namespace
{

constexpr Json::ParseLimits LINE_LIMITS{64U * 1024U, 4};

template <typename TEvent>
Core::Result<WorldEvent> DecodeAs(const Json::Value& value)
{
    Json::DecodeOptions options;
    options.bUnknownMembersRefused = true;
    options.bWordsInAnyCase = false;
    Json::DecodeContext context(options);
    JournalLine<TEvent> line;
    if (!Json::TryDecode(value, line, {}, context))
    {
        return tl::make_unexpected(context.TakeError());
    }
    return std::move(line.event);
}

using DecodeFunction = Core::Result<WorldEvent> (*)(const Json::Value&);

/// Indexed by EWorldEvent.
constexpr std::array<DecodeFunction, std::variant_size_v<WorldEvent>> DECODERS{
    DecodeAs<RobotDocked>,
    DecodeAs<CarrierMoved>,
    DecodeAs<MemoryMoved>,
    DecodeAs<CoverMoved>,
    DecodeAs<ButtonPushed>,
    DecodeAs<CarrierPlaced>,
    DecodeAs<MemoryPlaced>};

} // namespace

std::string EncodeWorldEvent(const WorldEvent& event)
{
    std::string text;
    Json::JsonWriter writer(text);
    const auto kind = static_cast<EWorldEvent>(event.index());
    std::visit(
        [&writer, kind](const auto& happened) {
            Json::Encode(JournalLine<std::remove_cvref_t<decltype(happened)>>{kind, happened}, writer);
        },
        event);
    return text;
}

Core::Result<WorldEvent> DecodeWorldEvent(std::string_view line)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root = document.Parse(line, LINE_LIMITS);
    if (!root.has_value())
    {
        return tl::make_unexpected(root.error());
    }
    const Json::Value* const word = Json::FindFirstOrNull(**root, "event");
    EWorldEvent kind{};
    bool bExact = false;
    if (word == nullptr || !word->IsString()
        || !Json::TryReadWord(std::string_view(word->GetString(), word->GetStringLength()), kind, bExact) || !bExact)
    {
        return Core::Fail(
            Core::ECoreError::UnknownWord,
            "event",
            Json::ListWords<EWorldEvent>(),
            word == nullptr ? "nothing" : Json::ShortenForError(*word));
    }
    return DECODERS[static_cast<std::size_t>(kind)](**root);
}

} // namespace ACS::Sim
