#pragma once

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
    std::string _received; ///< The line that is not whole yet.
    std::string _sent;

public:
    /// The trace outlives it.
    ArmTrace(MessageTrace& trace, std::string robotID);

    void OnReceived(std::string_view bytes);
    void OnSent(std::string_view bytes);

    /// The connection has ended: what came of the next line is a line.
    void OnLost();

private:
    void Take(ProtocolBeast::EWireDirection direction, std::string_view bytes, std::string& kept);
    void Write(ProtocolBeast::EWireDirection direction, std::string_view line);
};

} // namespace ACS::Acsd
