#include "MosquittoConnection.hpp"

#include "MosquittoError.hpp"

#include <mosquitto.h>

#include <cerrno>
#include <chrono>

// When libmosquitto reads, writes and checks its keep-alive.
namespace ACS::VDA5050
{

namespace
{

constexpr std::chrono::seconds HOUSE_KEEPING_PERIOD{1}; ///< Interval of libmosquitto's keep-alive check.
constexpr int MAX_READS = 64;                           ///< Before others on the executor have their turn.
constexpr int PACKETS_PER_CALL = 1;

/// Reads a packet. What libmosquitto sends meanwhile is queued and not written at once: it drops a message of QoS 2 that the
/// broker has released if it cannot write the PUBCOMP.
int ReadPacket(mosquitto* client)
{
    mosquitto_threaded_set(client, true);
    const int code = mosquitto_loop_read(client, PACKETS_PER_CALL);
    mosquitto_threaded_set(client, false);
    return code;
}

} // namespace

void MosquittoConnection::WaitToRead()
{
    _socket.async_wait(
        boost::asio::posix::stream_descriptor::wait_read,
        [weak = weak_from_this()](const boost::system::error_code& error) {
            const std::shared_ptr<MosquittoConnection> self = weak.lock();
            if (self == nullptr || error || self->IsClosed() || !self->TryPermit())
            {
                return;
            }
            self->ReadAll();
            if (!self->IsClosed())
            {
                self->WaitToRead();
            }
        });
}

void MosquittoConnection::WaitToWrite()
{
    _bWaitsToWrite = true;
    _socket.async_wait(
        boost::asio::posix::stream_descriptor::wait_write,
        [weak = weak_from_this()](const boost::system::error_code& error) {
            const std::shared_ptr<MosquittoConnection> self = weak.lock();
            if (self == nullptr || error || self->IsClosed() || !self->TryPermit())
            {
                return;
            }
            self->_bWaitsToWrite = false;
            errno = 0;
            const int code = mosquitto_loop_write(self->GetClientOrNull(), PACKETS_PER_CALL);
            self->FinishCall(code, errno);
        });
}

void MosquittoConnection::WaitForHouseKeeping()
{
    _houseKeeping.expires_after(HOUSE_KEEPING_PERIOD);
    _houseKeeping.async_wait([weak = weak_from_this()](const boost::system::error_code& error) {
        const std::shared_ptr<MosquittoConnection> self = weak.lock();
        if (self == nullptr || error || self->IsClosed() || !self->TryPermit())
        {
            return;
        }
        errno = 0;
        const int code = mosquitto_loop_misc(self->GetClientOrNull());
        self->FinishCall(code, errno);
        if (!self->IsClosed())
        {
            self->WaitForHouseKeeping();
        }
    });
}

/// Before each call of libmosquitto that may send, which includes those that read: an acknowledgement makes room for messages that
/// wait. Closes the connection if nothing may be sent.
bool MosquittoConnection::TryPermit()
{
    const bool bPermitted = !_maySend || _maySend();
    if (!bPermitted)
    {
        Close(std::make_error_code(std::errc::operation_not_permitted));
    }
    return bPermitted;
}

void MosquittoConnection::ReadAll()
{
    // With TLS bytes may wait where the socket does not show them: read until a read brings nothing.
    for (int i = 0; i < MAX_READS && !IsClosed(); ++i)
    {
        const std::size_t before = _events.size();
        errno = 0;
        const int code = ReadPacket(GetClientOrNull());
        FinishCall(code, errno);
        if (_events.size() == before)
        {
            return;
        }
    }
}

void MosquittoConnection::FinishCall(int code, int systemError)
{
    if (IsClosed())
    {
        return;
    }
    const bool bSocketGone = mosquitto_socket(GetClientOrNull()) < 0;
    if (code != MOSQ_ERR_SUCCESS || bSocketGone)
    {
        const int reason = code != MOSQ_ERR_SUCCESS ? code : _closeCode;
        Close(MakeMosquittoError(reason, systemError));
        return;
    }
    if (!_bWaitsToWrite && mosquitto_want_write(GetClientOrNull()))
    {
        WaitToWrite();
    }
    if (!_events.empty())
    {
        PostDispatch();
    }
}

void MosquittoConnection::CloseSocket()
{
    _houseKeeping.cancel();
    _connectTimer.cancel();
    boost::system::error_code ignored;
    _socket.close(ignored); // NOLINT(bugprone-unused-return-value): nothing to do about it
    // The client itself goes with this object, or to the next one: this may be one of its own callbacks.
}

} // namespace ACS::VDA5050
