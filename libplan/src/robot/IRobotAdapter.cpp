#include <acs/plan/IRobotAdapter.hpp>

#include <utility>

namespace ACS::Planning
{

RejectedActions FindRejectedActions(const IRobotAdapter& adapter, ERobotType type, const ActionTable& actions)
{
    RejectedActions rejected;
    for (const auto& [name, rule] : actions)
    {
        std::optional<std::string> reason =
            rule.robotType == type ? adapter.GetRejectionReasonOrNull(name) : std::nullopt;
        if (reason.has_value())
        {
            rejected.emplace(name, std::move(*reason));
        }
    }
    return rejected;
}

} // namespace ACS::Planning
