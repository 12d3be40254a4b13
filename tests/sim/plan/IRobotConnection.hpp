#pragma once

#include <acs/plan/RobotCommand.hpp>

namespace ACS::Simulation
{

/// One robot's adapter in a running acsd, with what runs it. It ends with acsd.
class IRobotConnection
{
public:
    IRobotConnection() = default;
    IRobotConnection(const IRobotConnection&) = delete;
    IRobotConnection& operator=(const IRobotConnection&) = delete;
    virtual ~IRobotConnection() = default;

    virtual void Handle(const Planning::RobotCommand& command) = 0;
};

} // namespace ACS::Simulation
