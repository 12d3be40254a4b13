#include "commands/Requests.hpp"

#include <acs/json/JsonWriter.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

struct Target
{
    ECommand command;
    std::string_view path; ///< {} is the id.
};

constexpr std::array<Target, 15> READS{{
    {ECommand::Status, "/v1/status"},
    {ECommand::Plans, "/v1/plans"},
    {ECommand::Plan, "/v1/plans/{}"},
    {ECommand::Why, "/v1/snapshot"},
    {ECommand::Robots, "/v1/robots"},
    {ECommand::Robot, "/v1/robots/{}"},
    {ECommand::Actions, "/v1/robots/{}/actions"},
    {ECommand::Action, "/v1/robots/{}/actions"},
    {ECommand::Alarms, "/v1/alarms"},
    {ECommand::Links, "/v1/links"},
    {ECommand::Queue, "/v1/queue"},
    {ECommand::Site, "/v1/site"},
    {ECommand::Events, "/v1/events"},
    {ECommand::Trace, "/v1/trace"},
    {ECommand::Audit, "/v1/audit"},
}};

constexpr std::array<Target, 14> CHANGES{{
    {ECommand::TscPause, "/v1/tsc/pause"},
    {ECommand::TscResume, "/v1/tsc/resume"},
    {ECommand::Block, "/v1/site/block"},
    {ECommand::Unblock, "/v1/site/unblock"},
    {ECommand::Maintenance, "/v1/robots/{}/maintenance"},
    {ECommand::Carriers, "/v1/robots/{}/carriers"},
    {ECommand::Clear, "/v1/alarms/clear"},
    {ECommand::Cancel, "/v1/plans/{}/cancel"},
    {ECommand::Abort, "/v1/plans/{}/abort"},
    {ECommand::Pause, "/v1/plans/{}/pause"},
    {ECommand::Resume, "/v1/plans/{}/resume"},
    {ECommand::Priority, "/v1/plans/{}/priority"},
    {ECommand::Resolve, "/v1/plans/{}/jobs"},
    {ECommand::Skip, "/v1/plans/{}/steps"},
}};

template <std::size_t COUNT>
std::string FindPath(const std::array<Target, COUNT>& targets, ECommand command, const std::string& id)
{
    const auto found = std::ranges::find(targets, command, &Target::command);
    return found == targets.end() ? std::string() : fmt::format(fmt::runtime(found->path), EncodePercent(id));
}

/// "?limit=10&plan=P1" of those that have a value.
std::string MakeQuery(std::initializer_list<std::pair<std::string_view, const std::optional<std::string>&>> parameters)
{
    std::string query;
    for (const auto& [name, valueOrNull] : parameters)
    {
        if (valueOrNull.has_value())
        {
            query += fmt::format("{}{}={}", query.empty() ? "?" : "&", name, EncodePercent(*valueOrNull));
        }
    }
    return query;
}

std::optional<std::string> MakeTextOrNull(const std::optional<std::uint64_t>& numberOrNull)
{
    return numberOrNull.has_value() ? std::optional(std::to_string(*numberOrNull)) : std::nullopt;
}

void WriteMember(Json::JsonWriter& writer, std::string_view key, const std::optional<std::string>& valueOrNull)
{
    if (valueOrNull.has_value())
    {
        writer.Key(key);
        writer.WriteString(*valueOrNull);
    }
}

void WriteCarriers(Json::JsonWriter& writer, const std::vector<std::string>& carriers)
{
    writer.Key("carrierIds");
    writer.BeginArray();
    for (const std::string& carrier : carriers)
    {
        if (carrier.empty() || carrier == "-")
        {
            writer.WriteNull();
        }
        else
        {
            writer.WriteString(carrier);
        }
    }
    writer.EndArray();
}

/// The members of the body; nothing for a command without a body.
void WriteBody(Json::JsonWriter& writer, ECommand command, const CommandArguments& arguments)
{
    const bool bPlace = command == ECommand::Block || command == ECommand::Unblock;
    WriteMember(writer, "kind", bPlace ? std::optional(arguments.word) : std::nullopt);
    WriteMember(writer, "id", bPlace ? std::optional(arguments.id) : std::nullopt);
    WriteMember(writer, "reason", arguments.reason);
    WriteMember(writer, "outcome", command == ECommand::Resolve ? std::optional(arguments.word) : std::nullopt);
    if (command == ECommand::Maintenance)
    {
        writer.Key("on");
        writer.WriteBoolean(arguments.word == "on");
    }
    if (command == ECommand::Priority)
    {
        writer.Key("priority");
        writer.WriteInteger(arguments.number);
    }
    if (command == ECommand::Carriers)
    {
        WriteCarriers(writer, arguments.carriers);
    }
    if (command == ECommand::Clear)
    {
        WriteMember(writer, "robotId", arguments.id);
        WriteMember(writer, "errorCode", arguments.word);
        WriteMember(writer, "planId", arguments.plan);
        WriteMember(writer, "jobId", arguments.job);
    }
}

} // namespace

std::string MakeReadTarget(const AcsctlOptions& options)
{
    const CommandArguments& arguments = options.arguments;
    const std::string path = FindPath(READS, options.command, arguments.id);
    const std::optional<std::string> limit = MakeTextOrNull(arguments.limit);
    const std::optional<std::string> after = MakeTextOrNull(arguments.after);
    return path
        + MakeQuery(
               {{"state", arguments.state},
                {"plan", arguments.plan},
                {"robot", arguments.robot},
                {"lot", arguments.lot},
                {"transaction", arguments.transaction},
                {"limit", limit},
                {"after", after}});
}

std::optional<ApiRequest> MakeChangeOrNull(const AcsctlOptions& options)
{
    const CommandArguments& arguments = options.arguments;
    std::string path = FindPath(CHANGES, options.command, arguments.id);
    if (path.empty())
    {
        return std::nullopt;
    }
    if (options.command == ECommand::Resolve)
    {
        path += fmt::format("/{}/resolve", EncodePercent(arguments.jobID));
    }
    if (options.command == ECommand::Skip)
    {
        path += fmt::format("/{}/skip", arguments.number);
    }
    std::string body;
    Json::JsonWriter writer(body);
    writer.BeginObject();
    const std::size_t empty = body.size();
    WriteBody(writer, options.command, arguments);
    const bool bBody = body.size() != empty;
    writer.EndObject();
    return ApiRequest{"POST", std::move(path), bBody ? std::move(body) : std::string()};
}

std::optional<std::string> MakeQuestionOrNull(const AcsctlOptions& options)
{
    const CommandArguments& arguments = options.arguments;
    struct Question
    {
        ECommand command;
        std::string text;
    };
    const std::array<Question, 11> questions{{
        {ECommand::Cancel, fmt::format("Cancel plan {}?", arguments.id)},
        {ECommand::Abort, fmt::format("Abort plan {}?", arguments.id)},
        {ECommand::Resume, fmt::format("Resume plan {}? Its robot may move.", arguments.id)},
        {ECommand::Resolve,
         fmt::format(
             "Resolve job {} of plan {} as {}? This cannot be undone.",
             arguments.jobID,
             arguments.id,
             arguments.word)},
        {ECommand::Skip, fmt::format("Skip step {} of plan {}?", arguments.number, arguments.id)},
        {ECommand::Clear, fmt::format("Clear alarm {} of {}?", arguments.word, arguments.id)},
        {ECommand::Carriers,
         fmt::format("Record carriers {} on {}?", fmt::join(arguments.carriers, " "), arguments.id)},
        {ECommand::Action, fmt::format("Send {} to {}?", arguments.word, arguments.id)},
        {ECommand::TscResume, "Resume the TSC? Robots may move."},
        {ECommand::Unblock, fmt::format("Unblock {} {}? Robots may drive there.", arguments.word, arguments.id)},
        {ECommand::Maintenance, fmt::format("Put {} back into service? It may move.", arguments.id)},
    }};
    const auto* const found = std::ranges::find(questions, options.command, &Question::command);
    const bool bStops = options.command == ECommand::Maintenance && arguments.word == "on";
    return found == questions.end() || bStops ? std::nullopt : std::optional(found->text);
}

} // namespace ACS::Acsctl
