#include "trace/TraceCommand.hpp"

#include "commands/Answers.hpp"
#include "common/trace/NewestLines.hpp"
#include "common/trace/TraceQuery.hpp"
#include "trace/TraceMerge.hpp"
#include "trace/TracePlans.hpp"

#include <cstddef>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

constexpr std::size_t DEFAULT_LINES = 100;
constexpr std::size_t NEWEST_BYTES = 256U * 1024U * 1024U;

/// Adds the lines that match.
Outcome<void> SelectLines(TraceMerge& merge, const CommandArguments& arguments, Apps::NewestLines& newest)
{
    const Apps::TraceQuery query{{}, arguments.robot.value_or(""), arguments.transaction.value_or("")};
    TracePlans plans;
    while (true)
    {
        const Outcome<const std::string*> line = merge.ReadNextOrNull();
        if (!line.has_value())
        {
            return tl::make_unexpected(line.error());
        }
        if (*line == nullptr)
        {
            return {};
        }
        const std::string plan = plans.FindPlan(**line);
        if ((!arguments.plan.has_value() || plan == *arguments.plan) && query.IsMatch(**line))
        {
            newest.Add(**line);
        }
    }
}

} // namespace

Outcome<std::string> RunTraceFiles(const AcsctlOptions& options, const ViewContext& context)
{
    if (options.watch.has_value())
    {
        return FailWith(EXIT_BAD_INPUT, "--watch is for commands that ask acsd: leave it out with --file");
    }
    Outcome<std::vector<TraceSource>> sources = FindTraceSources(options.arguments.files);
    if (!sources.has_value())
    {
        return tl::make_unexpected(std::move(sources.error()));
    }
    TraceMerge merge(std::move(*sources));
    const std::size_t lines = options.arguments.limit.value_or(DEFAULT_LINES);
    Apps::NewestLines newest(lines, NEWEST_BYTES);
    if (const Outcome<void> selected = SelectLines(merge, options.arguments, newest); !selected.has_value())
    {
        return tl::make_unexpected(selected.error());
    }
    Outcome<Shown> shown = ShowAnswer(options, newest.GetText(lines), context);
    return shown.has_value() ? Outcome<std::string>(std::move(shown->text)) : tl::make_unexpected(shown.error());
}

} // namespace ACS::Acsctl
