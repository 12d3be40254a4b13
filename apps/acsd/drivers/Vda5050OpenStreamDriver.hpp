#pragma once

#include <acs/acsd/IRobotDriver.hpp>

namespace ACS::Acsd
{

/// A VDA5050 vehicle with an arm whose controller has Open Stream: the driver `vda5050_openstream`.
class Vda5050OpenStreamDriver final : public IRobotDriver
{
public:
    [[nodiscard]] std::string_view GetName() const noexcept override;
    [[nodiscard]] std::unique_ptr<IRobotSetup> MakeSetupOrNull(const DrivenRobotConfig& config) const override;
};

} // namespace ACS::Acsd
