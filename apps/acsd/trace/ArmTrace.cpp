#include "trace/ArmTrace.hpp"

#include <functional>
#include <utility>

namespace ACS::Acsd
{

ArmTrace::ArmTrace(MessageTrace& trace, std::string robotID)
    : _trace(trace),
      _robotID(std::move(robotID))
{
}

void ArmTrace::OnReceived(std::string_view bytes)
{
    _received.Add(bytes, std::bind_front(&ArmTrace::Write, this, ProtocolBeast::EWireDirection::In));
}

void ArmTrace::OnSent(std::string_view bytes)
{
    _sent.Add(bytes, std::bind_front(&ArmTrace::Write, this, ProtocolBeast::EWireDirection::Out));
}

void ArmTrace::OnLost()
{
    _received.Finish(std::bind_front(&ArmTrace::Write, this, ProtocolBeast::EWireDirection::In));
    _sent.Finish(std::bind_front(&ArmTrace::Write, this, ProtocolBeast::EWireDirection::Out));
}

void ArmTrace::Write(ProtocolBeast::EWireDirection direction, std::string_view line)
{
    _trace.Write({"arm", direction, _robotID, {}, line});
}

} // namespace ACS::Acsd
