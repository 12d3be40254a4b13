#include "ServiceCaller.hpp"

#include <utility>

namespace ACS::OpenStreamAsio
{

ServiceCaller::ServiceCaller(
    const boost::asio::any_io_executor& executor,
    OpenStream::IOpenApiService& service,
    AnswerHandler onDelayed)
    : _service(service),
      _timers(std::make_shared<Timers>(executor, [this, handler = std::move(onDelayed)](EAnswer kind) {
          handler(_answers.at(static_cast<std::size_t>(kind)));
      }))
{
}

const ServiceCaller::Answer& ServiceCaller::Call(const OpenStream::ServerCall& call, Core::Now now)
{
    const EAnswer kind = call.request->method == OpenStream::EApiMethod::Get ? EAnswer::Sample : EAnswer::Control;
    Answer& answer = _answers.at(static_cast<std::size_t>(kind));
    answer.kind = kind;
    answer.token = call.token;
    _service.Call(*call.request, now, answer.response);
    return answer;
}

bool ServiceCaller::TryDelay(const Answer& answer)
{
    const bool bDelayed = answer.response.delay > Core::Duration::zero();
    if (bDelayed)
    {
        _timers->Start(answer.kind, answer.response.delay);
    }
    return bDelayed;
}

void ServiceCaller::StopControl(Core::Now now)
{
    _service.StopControl(now);
}

void ServiceCaller::Cancel()
{
    _timers->CancelAll();
}

} // namespace ACS::OpenStreamAsio
