#pragma once

#include "judge/ERule.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ACS::AcsSim
{

/// What was seen of each rule. Pure.
class RuleBook
{
public:
    struct Row
    {
        std::uint64_t kept = 0;
        std::uint64_t violated = 0;
        std::string first; ///< What violated it first.

        bool operator==(const Row&) const = default;
    };

private:
    std::array<Row, RULE_COUNT> _rows;
    std::vector<std::string> _news;

public:
    void Keep(ERule rule);
    void Violate(ERule rule, std::string text);
    /// Keeps or violates.
    void Judge(ERule rule, bool bKept, const std::string& text);

    [[nodiscard]] const Row& GetRow(ERule rule) const;
    [[nodiscard]] bool IsViolated() const;

    /// A line for each violation since the last call, "NAME (section): text". At most 20 of one rule are listed in all.
    [[nodiscard]] std::vector<std::string> ExtractNews();

    /// The table: a line for each rule, with its section, ok, violated or not seen, and the first violation.
    [[nodiscard]] std::vector<std::string> MakeTable() const;
};

} // namespace ACS::AcsSim
