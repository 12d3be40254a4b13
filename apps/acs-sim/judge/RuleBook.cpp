#include "judge/RuleBook.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace ACS::AcsSim
{

namespace
{

constexpr std::uint64_t MOST_NEWS = 20;

std::string MakeResult(const RuleBook::Row& row)
{
    if (row.violated > 0)
    {
        return fmt::format("VIOLATED {} of {}", row.violated, row.violated + row.kept);
    }
    return row.kept > 0 ? fmt::format("ok ({})", row.kept) : "not seen";
}

} // namespace

void RuleBook::Keep(ERule rule)
{
    ++_rows.at(static_cast<std::size_t>(rule)).kept;
}

void RuleBook::Violate(ERule rule, std::string text)
{
    Row& row = _rows.at(static_cast<std::size_t>(rule));
    if (++row.violated <= MOST_NEWS)
    {
        _news.push_back(fmt::format("{} ({}): {}", GetName(rule), GetSection(rule), text));
    }
    if (row.violated == 1)
    {
        row.first = std::move(text);
    }
}

void RuleBook::Judge(ERule rule, bool bKept, const std::string& text)
{
    if (bKept)
    {
        Keep(rule);
    }
    else
    {
        Violate(rule, text);
    }
}

const RuleBook::Row& RuleBook::GetRow(ERule rule) const
{
    return _rows.at(static_cast<std::size_t>(rule));
}

bool RuleBook::IsViolated() const
{
    return std::ranges::any_of(_rows, [](const Row& row) { return row.violated > 0; });
}

std::vector<std::string> RuleBook::ExtractNews()
{
    return std::exchange(_news, {});
}

std::vector<std::string> RuleBook::MakeTable() const
{
    std::vector<std::string> lines{
        fmt::format("{:<20} {:<9} {:<20} {}", "rule", "section", "result", "first violation")};
    for (std::size_t i = 0; i < RULE_COUNT; ++i)
    {
        const auto rule = static_cast<ERule>(i);
        std::string line = fmt::format(
            "{:<20} {:<9} {:<20} {}",
            GetName(rule),
            GetSection(rule),
            MakeResult(_rows.at(i)),
            _rows.at(i).first);
        line.erase(line.find_last_not_of(' ') + 1);
        lines.push_back(std::move(line));
    }
    return lines;
}

} // namespace ACS::AcsSim
