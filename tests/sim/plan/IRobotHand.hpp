#pragma once

#include <acs/plan/RobotCommand.hpp>

namespace ACS::Simulation
{

/// One robot's adapter in an acsd that lives, with what runs it. It goes when acsd does.
class IRobotHand
{
public:
    IRobotHand() = default;
    IRobotHand(const IRobotHand&) = delete;
    IRobotHand& operator=(const IRobotHand&) = delete;
    virtual ~IRobotHand() = default;

    virtual void Handle(const Planning::RobotCommand& command) = 0;
};

} // namespace ACS::Simulation
