#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ACS::Acsctl
{

/// What a finding is about.
enum class ESubject : std::uint8_t
{
    Acsd,
    Plan,
    Robot,
};

/// Why its subject does not move, and what to do.
struct Cause
{
    std::size_t depth = 0;           ///< 0: of the subject; one more for each cause of a cause.
    std::string text;                ///< A sentence.
    std::string origin;              ///< What leads to it; empty if unknown.
    std::vector<std::string> remedy; ///< What the operator can do; commands of acsctl are lines of their own.
};

/// One plan, robot, or acsd itself.
struct Finding
{
    ESubject subject = ESubject::Acsd;
    std::string id;          ///< Empty for acsd.
    std::string text;        ///< A sentence: its state.
    bool bAttention = false; ///< It does not move, or keeps others from moving.
    std::vector<Cause> causes;
};

/// The answer of `why`.
struct Explanation
{
    std::vector<Finding> findings;

    /// Whether a finding needs attention.
    [[nodiscard]] bool NeedsAttention() const;
};

} // namespace ACS::Acsctl
