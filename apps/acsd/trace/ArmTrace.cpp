#include "trace/ArmTrace.hpp"

#include <cstddef>
#include <utility>

namespace ACS::Acsd
{

namespace
{

/// A line without an end does not fill the memory.
constexpr std::size_t LONGEST_LINE = 1024U * 1024U;

} // namespace

ArmTrace::ArmTrace(MessageTrace& trace, std::string robotID)
    : _trace(trace),
      _robotID(std::move(robotID))
{
}

void ArmTrace::OnReceived(std::string_view bytes)
{
    Take(ProtocolBeast::EWireDirection::In, bytes, _received);
}

void ArmTrace::OnSent(std::string_view bytes)
{
    Take(ProtocolBeast::EWireDirection::Out, bytes, _sent);
}

void ArmTrace::OnLost()
{
    Write(ProtocolBeast::EWireDirection::In, std::exchange(_received, {}));
    Write(ProtocolBeast::EWireDirection::Out, std::exchange(_sent, {}));
}

void ArmTrace::Take(ProtocolBeast::EWireDirection direction, std::string_view bytes, std::string& kept)
{
    for (std::size_t end = bytes.find('\n'); end != std::string_view::npos; end = bytes.find('\n'))
    {
        kept.append(bytes.substr(0, end));
        bytes.remove_prefix(end + 1);
        Write(direction, kept);
        kept.clear();
    }
    kept.append(bytes);
    if (kept.size() > LONGEST_LINE)
    {
        Write(direction, std::exchange(kept, {}));
    }
}

void ArmTrace::Write(ProtocolBeast::EWireDirection direction, std::string_view line)
{
    if (line.ends_with('\r'))
    {
        line.remove_suffix(1);
    }
    if (!line.empty())
    {
        _trace.Write({"arm", direction, _robotID, {}, line});
    }
}

} // namespace ACS::Acsd
