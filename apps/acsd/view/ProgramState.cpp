#include "view/ProgramState.hpp"

namespace ACS::Acsd
{

std::string DescribeDown(const LinkStatus& link)
{
    return link.notReadyReason.empty() ? "no connection: " + link.name : link.notReadyReason;
}

std::vector<std::string> ListNotReadyReasons(const ProgramState& program)
{
    std::vector<std::string> reasons;
    for (const LinkStatus& link : program.links)
    {
        if (!link.bUp)
        {
            reasons.push_back(DescribeDown(link));
        }
    }
    reasons.insert(reasons.end(), program.notReadyReasons.begin(), program.notReadyReasons.end());
    return reasons;
}

} // namespace ACS::Acsd
