// Runs a coroutine to its end.
#pragma once

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>

#include <optional>

namespace plcgw {

template <class T>
T await(boost::asio::io_context& loop, boost::asio::awaitable<T> work)
{
    std::optional<T> done;
    boost::asio::co_spawn(loop, std::move(work), [&](std::exception_ptr failed, T result) {
        if (failed)
            std::rethrow_exception(failed);
        done = std::move(result);
    });
    loop.restart();
    loop.run();
    return std::move(*done);
}

}  // namespace plcgw
