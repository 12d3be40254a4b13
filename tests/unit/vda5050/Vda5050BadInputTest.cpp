#include "Catch.hpp"
#include "MessageSample.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <rapidjson/document.h>
#include <rapidjson/pointer.h>
#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

using Core::ECoreError;

/// The error of Decode; null when the payload is accepted.
template <typename TMessage>
std::optional<Core::Error> FindErrorOrNull(std::string_view payload)
{
    Core::Result<TMessage> message = Vda5050Codec().Decode<TMessage>(payload);
    return message.has_value() ? std::nullopt : std::optional(message.error());
}

struct Kind
{
    ETopic topic;
    std::optional<Core::Error> (*findErrorOrNull)(std::string_view payload);
};

constexpr std::array<Kind, TOPIC_COUNT> KINDS{
    Kind{ETopic::Order, &FindErrorOrNull<OrderMessage>},
    Kind{ETopic::InstantActions, &FindErrorOrNull<InstantActionsMessage>},
    Kind{ETopic::State, &FindErrorOrNull<StateMessage>},
    Kind{ETopic::Visualization, &FindErrorOrNull<VisualizationMessage>},
    Kind{ETopic::Connection, &FindErrorOrNull<ConnectionMessage>},
    Kind{ETopic::Factsheet, &FindErrorOrNull<FactsheetMessage>}};

/// A value of a message: where RapidJSON finds it, and how an error names it.
struct Place
{
    std::string pointer;
    std::string path;
    rapidjson::Type type = rapidjson::kNullType;
};

/// Every value of a message except those whose form the standard leaves open.
std::vector<Place> ListPlaces(const rapidjson::Document& message)
{
    constexpr std::array<std::string_view, 3> FREE{"value", "data", "localizationParameters"};
    std::vector<Place> places{{"", "", message.GetType()}};
    for (std::size_t index = 0; index < places.size(); ++index)
    {
        const Place place = places[index];
        const rapidjson::Value& value = *rapidjson::Pointer(place.pointer.c_str()).Get(message);
        if (value.IsObject())
        {
            for (const auto& member : value.GetObject())
            {
                const std::string name = member.name.GetString();
                // "versions" of vehicleConfig have a value that is a string
                const bool bFree =
                    std::ranges::find(FREE, name) != FREE.end() && !place.path.starts_with("vehicleConfig");
                const bool bEnvelopeText = name == "description" && place.path.starts_with("agvGeometry.envelopes3d");
                if (!bFree && !bEnvelopeText)
                {
                    const std::string path = place.path.empty() ? name : place.path + "." + name;
                    places.push_back({place.pointer + "/" + name, path, member.value.GetType()});
                }
            }
        }
        if (value.IsArray())
        {
            for (rapidjson::SizeType item = 0; item < value.Size(); ++item)
            {
                const std::string number = std::to_string(item);
                places.push_back(
                    {place.pointer + "/" + number, place.path + "[" + number + "]", value[item].GetType()});
            }
        }
    }
    return places;
}

std::string ReplaceAt(const rapidjson::Document& message, const std::string& pointer, const char* json)
{
    rapidjson::Document copy;
    copy.CopyFrom(message, copy.GetAllocator());
    rapidjson::Document value(&copy.GetAllocator());
    value.Parse(json);
    rapidjson::Pointer(pointer.c_str()).Set(copy, static_cast<rapidjson::Value&>(value));
    rapidjson::StringBuffer buffer;
    rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
    copy.Accept(writer);
    return {buffer.GetString(), buffer.GetSize()};
}

bool IsBoolean(rapidjson::Type type)
{
    return type == rapidjson::kTrueType || type == rapidjson::kFalseType;
}

} // namespace

TEST_CASE("3 Each value of each message is refused in any wrong type, and the error names its path")
{
    constexpr std::array<const char*, 5> WRONG{R"("text")", "5", "true", "[]", "{}"};
    constexpr std::array WRONG_TYPES{
        rapidjson::kStringType,
        rapidjson::kNumberType,
        rapidjson::kTrueType,
        rapidjson::kArrayType,
        rapidjson::kObjectType};
    for (const EVda5050Version version : VERSIONS)
    {
        for (const Kind& kind : KINDS)
        {
            const std::string text = ReadFull(kind.topic, version);
            rapidjson::Document message;
            message.Parse(text.c_str());
            for (const Place& place : ListPlaces(message))
            {
                for (std::size_t index = 0; index < WRONG.size(); ++index)
                {
                    if (WRONG_TYPES[index] == place.type || (IsBoolean(WRONG_TYPES[index]) && IsBoolean(place.type)))
                    {
                        continue;
                    }
                    const std::string broken = ReplaceAt(message, place.pointer, WRONG[index]);
                    CAPTURE(GetTopicName(kind.topic), place.path, WRONG[index]);
                    const std::optional<Core::Error> error = kind.findErrorOrNull(broken);
                    REQUIRE(error.has_value());
                    CHECK(error->path == place.path);
                    CHECK(error->code == ECoreError::WrongType);
                    CHECK_FALSE(error->expected.empty());
                    CHECK_FALSE(error->found.empty());
                }
            }
        }
    }
}

TEST_CASE("12 (13) null is refused in each member that must be there, and nowhere else")
{
    for (const EVda5050Version version : VERSIONS)
    {
        for (const Kind& kind : KINDS)
        {
            // A minimal message has the required members, and objects that may be missing.
            const std::string text = ReadGolden(kind.topic, version, "minimal");
            rapidjson::Document message;
            message.Parse(text.c_str());
            for (const Place& place : ListPlaces(message))
            {
                const std::string broken = ReplaceAt(message, place.pointer, "null");
                CAPTURE(GetTopicName(kind.topic), place.path);
                const std::optional<Core::Error> error = kind.findErrorOrNull(broken);
                if (error.has_value())
                {
                    CHECK(error->path == place.path);
                    CHECK(error->code == ECoreError::WrongType);
                    CHECK(error->found == "null");
                }
                else
                {
                    // Then it may be missing altogether; an element of an array may not be null.
                    CHECK(place.path.back() != ']');
                    rapidjson::Document copy;
                    copy.CopyFrom(message, copy.GetAllocator());
                    REQUIRE(rapidjson::Pointer(place.pointer.c_str()).Erase(copy));
                    rapidjson::StringBuffer buffer;
                    rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
                    copy.Accept(writer);
                    CHECK_FALSE(kind.findErrorOrNull(buffer.GetString()).has_value());
                }
            }
        }
    }
}

TEST_CASE("3 A message that is cut off anywhere is rejected, and so is text that is not JSON or not a message")
{
    for (const Kind& kind : KINDS)
    {
        const std::string text = ReadFull(kind.topic, EVda5050Version::Version210);
        for (std::size_t length = 0; length < text.size(); ++length)
        {
            CAPTURE(GetTopicName(kind.topic), length);
            REQUIRE(kind.findErrorOrNull(std::string_view(text).substr(0, length)).has_value());
        }
        for (const std::string junk : {"", " ", "null", "5", "\"text\"", "[]", "[{}]", "nonsense", "{]", "\xff\xfe{}"})
        {
            CAPTURE(GetTopicName(kind.topic), junk);
            CHECK(kind.findErrorOrNull(junk).has_value());
        }
        CHECK(kind.findErrorOrNull(text + "{}").has_value());
        CHECK(kind.findErrorOrNull(text + std::string(1, '\0')).has_value());
        CHECK(kind.findErrorOrNull(Replace(text, "\"KIT\"", "\"K\xC3\"")).has_value());
        CHECK(kind.findErrorOrNull(Replace(text, "\"KIT\"", R"("\ud800")")).has_value());
        CHECK(kind.findErrorOrNull(Replace(text, R"("headerId")", R"("headerId":7,"headerId")")).has_value());
        CHECK(kind.findErrorOrNull(Replace(text, R"("headerId")", R"("a":1,"a":1,"headerId")")).has_value());
    }
}

TEST_CASE("3.1 An invalid header is rejected; a version, a name or an id is any text")
{
    struct Case
    {
        const char* from;
        const char* to;
        ECoreError code;
    };
    const Case wrong = GENERATE(
        Case{R"("headerId":7)", R"("headerId":-1)", ECoreError::OutOfRange},
        Case{R"("headerId":7)", R"("headerId":4294967296)", ECoreError::OutOfRange},
        Case{R"("headerId":7)", R"("headerId":18446744073709551616)", ECoreError::OutOfRange},
        Case{R"("headerId":7)", R"("headerId":1e300)", ECoreError::OutOfRange},
        Case{R"("headerId":7)", R"("headerId":7.5)", ECoreError::OutOfRange},
        Case{R"("headerId":7)", R"("headerId":NaN)", ECoreError::InvalidJSON},
        Case{R"("headerId":7)", R"("headerId":Infinity)", ECoreError::InvalidJSON},
        Case{R"("headerId":7)", R"("headerId":07)", ECoreError::InvalidJSON},
        Case{R"("2026-11-20T23:37:12.345Z")", R"("")", ECoreError::InvalidTimestamp},
        Case{R"("2026-11-20T23:37:12.345Z")", R"("2026-02-30T00:00:00Z")", ECoreError::InvalidTimestamp},
        Case{R"("2026-11-20T23:37:12.345Z")", R"("1763681832")", ECoreError::InvalidTimestamp});
    for (const Kind& kind : KINDS)
    {
        const std::string text = ReadFull(kind.topic, EVda5050Version::Version200);
        CAPTURE(GetTopicName(kind.topic), wrong.to);
        const std::optional<Core::Error> error = kind.findErrorOrNull(Replace(text, wrong.from, wrong.to));
        REQUIRE(error.has_value());
        CHECK(error->code == wrong.code);
        CHECK_FALSE(kind.findErrorOrNull(Replace(text, R"("2.0.0")", R"("99.x")")).has_value());
        CHECK_FALSE(kind.findErrorOrNull(Replace(text, R"("KIT")", R"("a/b+#$")")).has_value());
        CHECK_FALSE(kind.findErrorOrNull(Replace(text, R"("headerId":7)", R"("headerId":4294967295)")).has_value());
        CHECK_FALSE(kind.findErrorOrNull(Replace(text, R"("headerId":7)", R"("headerId":7.0)")).has_value());
    }
}

TEST_CASE("3 A number out of range and a word that is not listed are rejected; the error states what is valid")
{
    struct Case
    {
        ETopic topic;
        const char* from;
        const char* to;
        const char* path;
        ECoreError code;
    };
    const Case wrong = GENERATE(
        Case{ETopic::Order, R"("orderUpdateId":3)", R"("orderUpdateId":-3)", "orderUpdateId", ECoreError::OutOfRange},
        Case{ETopic::Order, R"("sequenceId":1)", R"("sequenceId":-1)", "edges[0].sequenceId", ECoreError::OutOfRange},
        Case{ETopic::Order, R"("x":0.5)", R"("x":1e999)", "", ECoreError::InvalidJSON},
        Case{ETopic::Order, R"("x":0.5)", R"("x":NaN)", "", ECoreError::InvalidJSON},
        Case{
            ETopic::Order,
            R"("theta":1.5)",
            R"("theta":-3.15)",
            "nodes[0].nodePosition.theta",
            ECoreError::OutOfRange},
        Case{
            ETopic::Order,
            R"("allowedDeviationXY":0.1)",
            R"("allowedDeviationXY":-0.1)",
            "nodes[0].nodePosition.allowedDeviationXY",
            ECoreError::OutOfRange},
        Case{
            ETopic::Order,
            R"("allowedDeviationTheta":0.2)",
            R"("allowedDeviationTheta":-0.2)",
            "nodes[0].nodePosition.allowedDeviationTheta",
            ECoreError::OutOfRange},
        Case{ETopic::Order, R"("degree":2)", R"("degree":0)", "edges[0].trajectory.degree", ECoreError::OutOfRange},
        Case{
            ETopic::Order,
            R"("knotVector":[0,)",
            R"("knotVector":[-1,)",
            "edges[0].trajectory.knotVector[0]",
            ECoreError::OutOfRange},
        Case{
            ETopic::Order,
            R"("weight":0.7)",
            R"("weight":-0.7)",
            "edges[0].trajectory.controlPoints[1].weight",
            ECoreError::OutOfRange},
        Case{
            ETopic::Order,
            R"("leftWidth":0.5)",
            R"("leftWidth":-0.5)",
            "edges[0].corridor.leftWidth",
            ECoreError::OutOfRange},
        Case{
            ETopic::Order,
            R"("CONTOUR")",
            R"("MIDDLE")",
            "edges[0].corridor.corridorRefPoint",
            ECoreError::UnknownWord},
        Case{ETopic::Order, R"("GLOBAL")", R"("LOCAL")", "edges[0].orientationType", ECoreError::UnknownWord},
        Case{
            ETopic::InstantActions,
            R"("value":"EPAL")",
            R"("value":null)",
            "actions[0].actionParameters[0].value",
            ECoreError::WrongType},
        Case{ETopic::InstantActions, R"("SOFT")", R"("SINGLE")", "actions[2].blockingType", ECoreError::UnknownWord},
        Case{
            ETopic::State,
            R"("lastNodeSequenceId":0)",
            R"("lastNodeSequenceId":-1)",
            "lastNodeSequenceId",
            ECoreError::OutOfRange},
        Case{
            ETopic::State,
            R"("localizationScore":0.9)",
            R"("localizationScore":1.1)",
            "agvPosition.localizationScore",
            ECoreError::OutOfRange},
        Case{
            ETopic::State,
            R"("batteryHealth":97)",
            R"("batteryHealth":101)",
            "batteryState.batteryHealth",
            ECoreError::OutOfRange},
        Case{ETopic::State, R"("weight":120)", R"("weight":-1)", "loads[0].weight", ECoreError::OutOfRange},
        Case{ETopic::State, R"("FAILED")", R"("RETRIABLE")", "actionStates[5].actionStatus", ECoreError::UnknownWord},
        Case{ETopic::State, R"("TEACHIN")", R"("ASLEEP")", "operatingMode", ECoreError::UnknownWord},
        Case{ETopic::State, R"("FATAL")", R"("SEVERE")", "errors[0].errorLevel", ECoreError::UnknownWord},
        Case{ETopic::State, R"("DEBUG")", R"("TRACE")", "information[0].infoLevel", ECoreError::UnknownWord},
        Case{ETopic::State, R"("REMOTE")", R"("PRESSED")", "safetyState.eStop", ECoreError::UnknownWord},
        Case{ETopic::State, R"("ENABLED")", R"("ACTIVE")", "maps[0].mapStatus", ECoreError::UnknownWord},
        Case{
            ETopic::Connection,
            R"("CONNECTIONBROKEN")",
            R"("HIBERNATING")",
            "connectionState",
            ECoreError::UnknownWord},
        Case{ETopic::Visualization, R"("theta":3.14)", R"("theta":4)", "agvPosition.theta", ECoreError::OutOfRange},
        Case{
            ETopic::Factsheet,
            R"("maxLoadMass":500)",
            R"("maxLoadMass":-1)",
            "typeSpecification.maxLoadMass",
            ECoreError::OutOfRange},
        Case{
            ETopic::Factsheet,
            R"("order.nodes":10)",
            R"("order.nodes":-1)",
            "protocolLimits.maxArrayLens.order.nodes",
            ECoreError::OutOfRange},
        Case{ETopic::Factsheet, R"("OMNI")", R"("HOVER")", "typeSpecification.agvKinematic", ECoreError::UnknownWord});
    const Kind& kind = KINDS.at(static_cast<std::size_t>(wrong.topic));
    const std::string text = Replace(ReadFull(wrong.topic, EVda5050Version::Version210), wrong.from, wrong.to);
    CAPTURE(GetTopicName(wrong.topic), wrong.to);
    const std::optional<Core::Error> error = kind.findErrorOrNull(text);
    REQUIRE(error.has_value());
    CHECK(error->path == wrong.path);
    CHECK(error->code == wrong.code);
    CHECK_FALSE(error->expected.empty());
}

} // namespace ACS::VDA5050::Test
