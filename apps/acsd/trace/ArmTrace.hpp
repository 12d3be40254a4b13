#pragma once

#include "common/trace/LineCollector.hpp"
#include "trace/MessageTrace.hpp"

#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// Makes lines for the trace of what comes and goes over one arm's connection.
class ArmTrace final
{
    MessageTrace& _trace;
    std::string _robotID;
    Apps::LineCollector _received;
    Apps::LineCollector _sent;

public:
    /// The trace outlives it.
    ArmTrace(MessageTrace& trace, std::string robotID);

    void OnReceived(std::string_view bytes);
    void OnSent(std::string_view bytes);

    /// The connection has ended: what came of the next line is a line.
    void OnLost();

private:
    void Write(ProtocolBeast::EWireDirection direction, std::string_view line);
};

} // namespace ACS::Acsd
