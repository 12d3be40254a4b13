#include "robots/ArmControls.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsd
{

namespace
{

/// Of the text of a refusal.
constexpr std::size_t LONGEST_BODY = 200;

} // namespace

ArmRefusal MakeArmRefusal(int status, const std::optional<Core::JsonText>& bodyOrNull, const std::string& detail)
{
    ArmRefusal refusal;
    refusal.reason = fmt::format(
        "the arm's controller refuses, status {}: {}",
        status,
        bodyOrNull.has_value() ? bodyOrNull->GetText().substr(0, LONGEST_BODY) : detail);
    refusal.status = status;
    refusal.codeOrNull = bodyOrNull.has_value() ? ReadErrorCodeOrNull(*bodyOrNull) : std::nullopt;
    return refusal;
}

ArmControls::ArmControls(RobotOutputs& outputs)
    : _outputs(outputs)
{
}

void ArmControls::Send(EArmControl kind, std::string_view url, std::string body)
{
    OpenStream::ControlRequest request;
    request.url = url;
    request.body = Core::JsonText::FromTrusted(std::move(body));
    _unsettled.push_back(kind);
    _outputs.armRequests.emplace_back(std::move(request));
}

std::optional<ArmSettlement> ArmControls::SettleOrNull(const OpenStream::ClientControlSettled& settled)
{
    if (_unsettled.empty())
    {
        return std::nullopt;
    }
    ArmSettlement settlement{
        _unsettled.front(),
        settled.outcome,
        MakeArmRefusal(settled.status, settled.body, settled.detail)};
    _unsettled.pop_front();
    return settlement;
}

bool ArmControls::IsIdle() const noexcept
{
    return _unsettled.empty();
}

} // namespace ACS::Acsd
