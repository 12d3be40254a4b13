#pragma once

#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonEncoder.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Json::Test
{

enum class EColour : std::uint8_t
{
    Red,
    Green,
};

struct SampleHeader
{
    std::uint32_t headerID = 0;
    std::string version;

    bool operator==(const SampleHeader&) const = default;
};

struct SampleJob
{
    std::string jobID;
    std::optional<std::string> from;

    bool operator==(const SampleJob&) const = default;
};

/// Has a field of every kind that messages have.
struct SampleMessage
{
    SampleHeader header;
    std::string planID;
    std::optional<std::int64_t> priority;
    std::vector<SampleJob> jobs;
    std::vector<std::string> tags;
    double x = 0.0;
    EColour colour = EColour::Red;
    std::vector<std::optional<std::string>> carriers;
    std::optional<std::string> stepID;
    Core::JsonText value;
    bool bOn = false;

    bool operator==(const SampleMessage&) const = default;
};

} // namespace ACS::Json::Test

namespace ACS::Json
{

template <>
struct EnumNames<Test::EColour>
{
    static constexpr std::array WORDS{
        EnumWord<Test::EColour>{Test::EColour::Red, "Red"},
        EnumWord<Test::EColour>{Test::EColour::Green, "Green"}};
};

template <>
struct JsonFields<Test::SampleHeader>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("headerId", &Test::SampleHeader::headerID),
        Required("version", &Test::SampleHeader::version));
};

template <>
struct JsonFields<Test::SampleJob>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("jobId", &Test::SampleJob::jobID).WithLength(1, 8),
        Optional("from", &Test::SampleJob::from));
};

template <>
struct JsonFields<Test::SampleMessage>
{
    static constexpr auto FIELDS = std::make_tuple(
        Flat(&Test::SampleMessage::header),
        Required("planId", &Test::SampleMessage::planID),
        Optional("priority", &Test::SampleMessage::priority),
        Defaulted("jobs", &Test::SampleMessage::jobs),
        Optional("tags", &Test::SampleMessage::tags),
        Required("x", &Test::SampleMessage::x).Between(-10, 10),
        Required("colour", &Test::SampleMessage::colour),
        Defaulted("carriers", &Test::SampleMessage::carriers),
        Nullable("stepId", &Test::SampleMessage::stepID),
        Defaulted("value", &Test::SampleMessage::value),
        Required("on", &Test::SampleMessage::bOn));
};

} // namespace ACS::Json
