#include "why/WhyText.hpp"

#include <algorithm>
#include <array>

namespace ACS::Acsctl
{

namespace
{

constexpr std::array<std::string_view, 4> FINAL_STATUSES{"Completed", "Failed", "Cancelled", "Aborted"};
constexpr std::array<std::string_view, 5> UNUSABLE_STATUSES{"Error", "Stopped", "Disconnected", "Manual", "Init"};

} // namespace

std::string MakeSentence(std::string text)
{
    if (!text.empty() && text.find_last_of(".!?") != text.size() - 1)
    {
        text += '.';
    }
    return text;
}

std::string Capitalize(std::string word)
{
    if (!word.empty() && word.front() >= 'a' && word.front() <= 'z')
    {
        word.front() = static_cast<char>(word.front() - 'a' + 'A');
    }
    return word;
}

bool IsFinalStatus(std::string_view status)
{
    return std::find(FINAL_STATUSES.begin(), FINAL_STATUSES.end(), status) != FINAL_STATUSES.end();
}

bool IsUnusableStatus(std::string_view status)
{
    return std::find(UNUSABLE_STATUSES.begin(), UNUSABLE_STATUSES.end(), status) != UNUSABLE_STATUSES.end();
}

bool IsStopped(const PlanInfo& plan)
{
    return plan.waits.has_value() || plan.status == "Paused";
}

} // namespace ACS::Acsctl
