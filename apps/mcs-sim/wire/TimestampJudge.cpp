#include "wire/TimestampJudge.hpp"

#include "console/CleanText.hpp"
#include <acs/core/Timestamp.hpp>
#include <acs/json/JsonDocument.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace ACS::McsSim
{

namespace
{

constexpr std::size_t SECONDS_LENGTH = std::string_view("2025-07-02T21:00:00").size();

constexpr bool IsDigit(char character) noexcept
{
    return character >= '0' && character <= '9';
}

/// The timestamp of a message on the wire; empty where there is none.
std::string ReadTimestamp(std::string_view text)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> value = document.Parse(text, {});
    if (!value.has_value() || !(*value)->IsObject())
    {
        return {};
    }
    const auto member = (*value)->FindMember("timestamp");
    return member != (*value)->MemberEnd() && member->value.IsString()
        ? std::string(member->value.GetString(), member->value.GetStringLength())
        : std::string();
}

/// Of a timestamp that ParseTimestamp reads.
std::vector<ETimestampDeviation> FindDeviations(std::string_view timestamp)
{
    std::vector<ETimestampDeviation> deviations;
    std::string_view rest = timestamp.substr(SECONDS_LENGTH);
    std::size_t digits = 0;
    if (rest.starts_with('.'))
    {
        rest.remove_prefix(1);
        digits = static_cast<std::size_t>(std::ranges::find_if_not(rest, IsDigit) - rest.begin());
        rest.remove_prefix(digits);
    }
    if (digits != 3)
    {
        deviations.push_back(ETimestampDeviation::Fraction);
    }
    const bool bUTC = rest == "Z" || rest == "z";
    if (rest.empty() || bUTC)
    {
        deviations.push_back(bUTC ? ETimestampDeviation::Utc : ETimestampDeviation::NoOffset);
    }
    const bool bColon = rest.find(':') != std::string_view::npos;
    if (timestamp[SECONDS_LENGTH - 9] != 'T' || (!rest.empty() && !bUTC && !bColon))
    {
        deviations.push_back(ETimestampDeviation::OtherSpelling);
    }
    return deviations;
}

} // namespace

std::string_view GetMeaning(ETimestampDeviation deviation)
{
    switch (deviation)
    {
        case ETimestampDeviation::NoOffset:
            return "timestamp without offset";
        case ETimestampDeviation::Utc:
            return "timestamp with Z instead of the offset of local time";
        case ETimestampDeviation::Fraction:
            return "timestamp without exactly three digits of milliseconds";
        case ETimestampDeviation::OtherSpelling:
            return "timestamp in another spelling than the document's";
        default:
            assert(false);
            return "";
    }
}

std::vector<std::string> TimestampJudge::OnText(std::string_view text)
{
    std::vector<std::string> lines;
    const std::string timestamp = ReadTimestamp(text);
    if (!Core::ParseTimestamp(timestamp).has_value())
    {
        return lines; // The codec notes it.
    }
    for (const ETimestampDeviation deviation : FindDeviations(timestamp))
    {
        if (_counts[static_cast<std::size_t>(deviation)]++ == 0)
        {
            lines.push_back(fmt::format("ACS {}: {} (reported once)", GetMeaning(deviation), CleanText(timestamp)));
        }
    }
    return lines;
}

const TimestampCounts& TimestampJudge::GetCounts() const noexcept
{
    return _counts;
}

} // namespace ACS::McsSim
