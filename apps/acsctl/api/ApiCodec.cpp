#include "api/ApiCodec.hpp"

#include "api/ApiFields.hpp"
#include "view/DisplayText.hpp"
#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonDocument.hpp>

#include <utility>

namespace ACS::Json
{

/// An object whose members are counts.
template <>
struct ValueDecoder<Acsctl::StatusCounts>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        Acsctl::StatusCounts& out,
        const FieldBounds& /*bounds*/,
        DecodeContext& context)
    {
        if (!value.IsObject())
        {
            return context.IsFailedWith(Core::ECoreError::WrongType, "an object", &value);
        }
        out.counts.clear();
        for (const auto& member : value.GetObject())
        {
            const std::string_view name(member.name.GetString(), member.name.GetStringLength());
            auto& entry = out.counts.emplace_back(std::string(name), 0U);
            if (!Json::TryDecode(member.value, entry.second, FieldBounds(), context))
            {
                return context.IsFailedAt(name);
            }
        }
        return true;
    }
};

} // namespace ACS::Json

namespace ACS::Acsctl
{

namespace
{

constexpr std::size_t MAX_DEPTH = 32;
constexpr std::size_t MAX_VALUES = 3'000'000;
constexpr std::size_t MAX_ELEMENTS = 500'000;
constexpr std::size_t MAX_TEXT = 4U * 1024U * 1024U;

Json::ParseLimits MakeLimits()
{
    return {MAX_ANSWER_BYTES, MAX_DEPTH, MAX_VALUES};
}

} // namespace

template <typename T>
Core::Result<T> DecodeAnswer(std::string_view text)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root = document.Parse(text, MakeLimits());
    if (!root.has_value())
    {
        return tl::unexpected<Core::Error>(root.error());
    }
    Json::DecodeOptions options;
    options.maximumArray = MAX_ELEMENTS;
    options.maximumString = MAX_TEXT;
    Json::DecodeContext context(options);
    T answer;
    if (!Json::TryDecode(**root, answer, Json::FieldBounds(), context))
    {
        return tl::unexpected<Core::Error>(context.TakeError());
    }
    return answer;
}

template Core::Result<StatusInfo> DecodeAnswer<StatusInfo>(std::string_view text);
template Core::Result<PlanInfo> DecodeAnswer<PlanInfo>(std::string_view text);
template Core::Result<PlansAnswer> DecodeAnswer<PlansAnswer>(std::string_view text);
template Core::Result<RobotInfo> DecodeAnswer<RobotInfo>(std::string_view text);
template Core::Result<RobotsAnswer> DecodeAnswer<RobotsAnswer>(std::string_view text);
template Core::Result<AlarmsAnswer> DecodeAnswer<AlarmsAnswer>(std::string_view text);
template Core::Result<LinksAnswer> DecodeAnswer<LinksAnswer>(std::string_view text);
template Core::Result<QueueAnswer> DecodeAnswer<QueueAnswer>(std::string_view text);
template Core::Result<SiteAnswer> DecodeAnswer<SiteAnswer>(std::string_view text);
template Core::Result<SnapshotAnswer> DecodeAnswer<SnapshotAnswer>(std::string_view text);
template Core::Result<TraceLine> DecodeAnswer<TraceLine>(std::string_view text);
template Core::Result<AuditLine> DecodeAnswer<AuditLine>(std::string_view text);
template Core::Result<EntryEvent> DecodeAnswer<EntryEvent>(std::string_view text);
template Core::Result<ActionsAnswer> DecodeAnswer<ActionsAnswer>(std::string_view text);
template Core::Result<ActionAcceptedAnswer> DecodeAnswer<ActionAcceptedAnswer>(std::string_view text);
template Core::Result<MessageAnswer> DecodeAnswer<MessageAnswer>(std::string_view text);
template Core::Result<ErrorAnswer> DecodeAnswer<ErrorAnswer>(std::string_view text);

Core::Result<std::string> MakeOneLine(std::string_view text)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root = document.Parse(text, MakeLimits());
    if (!root.has_value())
    {
        return tl::unexpected<Core::Error>(root.error());
    }
    const std::size_t end = text.find_last_not_of(" \t\r\n") + 1;
    const std::string_view trimmed = text.substr(0, end);
    return MakeDisplayableJSON(
        trimmed.find_first_of("\r\n") == std::string_view::npos ? std::string(trimmed) : Json::WriteText(**root));
}

} // namespace ACS::Acsctl
