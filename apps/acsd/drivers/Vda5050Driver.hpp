#pragma once

#include <acs/acsd/IRobotDriver.hpp>

namespace ACS::Acsd
{

/// A VDA5050 vehicle: the driver `vda5050`.
class Vda5050Driver final : public IRobotDriver
{
public:
    [[nodiscard]] std::string_view GetName() const noexcept override;
    [[nodiscard]] std::unique_ptr<IRobotSetup> MakeSetupOrNull(const DrivenRobotConfig& config) const override;
};

} // namespace ACS::Acsd
