#include "RobotConnection.hpp"

#include <utility>

namespace ACS::Simulation
{

RobotConnection::RobotConnection(Timeline& timeline, RobotRadio& radio, std::uint64_t number, EventHandler handler)
    : _radio(radio),
      _adapter(number, [this](const RobotMessage& message) { _radio.Send(message); }),
      _runner(timeline, _adapter, std::move(handler), {})
{
    _radio.Attach(*this);
}

RobotConnection::~RobotConnection()
{
    _radio.Detach(*this);
}

void RobotConnection::Handle(const Planning::RobotCommand& command)
{
    _runner.Run([this, &command](Core::Now now, auto& out) { _adapter.Handle(command, now, out); });
}

void RobotConnection::OnRadioUp()
{
    _runner.Run([this](Core::Now /*now*/, auto& out) { _adapter.OnLinkUp(out); });
}

void RobotConnection::OnRadioDown()
{
    _runner.Run([this](Core::Now /*now*/, auto& out) { _adapter.OnLinkDown(out); });
}

void RobotConnection::OnSnapshot(const RobotSnapshot& snapshot)
{
    _runner.Run([this, &snapshot](Core::Now /*now*/, auto& out) { _adapter.OnSnapshot(snapshot, out); });
}

} // namespace ACS::Simulation
