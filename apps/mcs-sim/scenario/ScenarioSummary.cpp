#include "scenario/ScenarioSummary.hpp"

#include "console/CleanText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace ACS::McsSim
{

namespace
{

constexpr std::size_t VERDICT_COLUMNS = 12;
constexpr double MILLISECONDS_IN_SECOND = 1000.0;

std::string_view GetText(EVerdict verdict)
{
    switch (verdict)
    {
        case EVerdict::Held:
            return "held";
        case EVerdict::Failed:
            return "FAILED";
        case EVerdict::NotReached:
            return "not reached";
        default:
            assert(false);
            return "";
    }
}

EStyle GetStyle(EVerdict verdict)
{
    switch (verdict)
    {
        case EVerdict::Held:
            return EStyle::Good;
        case EVerdict::Failed:
            return EStyle::Bad;
        case EVerdict::NotReached:
            return EStyle::Dim;
        default:
            assert(false);
            return EStyle::Plain;
    }
}

StyledLine MakeLine(const StepVerdict& step)
{
    StyledLine line{
        {FitRight(fmt::format("{}", step.number), 5) + "  ", EStyle::Dim},
        {FitText(GetText(step.verdict), VERDICT_COLUMNS), GetStyle(step.verdict)},
        {CleanText(step.title), EStyle::Plain}};
    if (step.verdict != EVerdict::NotReached)
    {
        const double seconds = static_cast<double>(step.duration.count()) / MILLISECONDS_IN_SECOND;
        line.push_back({fmt::format("  {:.2f} s", seconds), EStyle::Dim});
    }
    if (!step.reason.empty())
    {
        line.push_back({": " + step.reason, EStyle::Bad});
    }
    return line;
}

} // namespace

StyledLines MakeScenarioTable(const std::vector<ScenarioResult>& results)
{
    StyledLines lines;
    for (const ScenarioResult& result : results)
    {
        lines.push_back(
            {{" scenario " + CleanText(result.name) + ": ", EStyle::Bold},
             {result.bHeld ? "passed" : "FAILED", result.bHeld ? EStyle::Good : EStyle::Bad}});
        for (const StepVerdict& step : result.verdicts)
        {
            if (step.bExpectation || step.verdict == EVerdict::Failed)
            {
                lines.push_back(MakeLine(step));
            }
        }
    }
    return lines;
}

std::string MakeScenarioLastLine(const std::vector<ScenarioResult>& results, std::size_t violations)
{
    std::ptrdiff_t expectations = 0;
    std::ptrdiff_t held = 0;
    for (const ScenarioResult& result : results)
    {
        const std::vector<StepVerdict>& steps = result.verdicts;
        expectations += std::count_if(steps.begin(), steps.end(), [](const auto& step) { return step.bExpectation; });
        held += std::count_if(steps.begin(), steps.end(), [](const StepVerdict& step) {
            return step.bExpectation && step.verdict == EVerdict::Held;
        });
    }
    return fmt::format(
        "{} of {} scenarios passed, {} of {} expectations held, {} violations",
        std::count_if(results.begin(), results.end(), [](const auto& result) { return result.bHeld; }),
        results.size(),
        held,
        expectations,
        violations);
}

} // namespace ACS::McsSim
