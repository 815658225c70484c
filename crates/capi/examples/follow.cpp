// Follows the setpoints of an instance, and writes them to a file as they are: C++17, with handles
// that close themselves and failures that are thrown.
//
//     c++ -std=c++17 follow.cpp -lglidepath -o follow
//     ./follow default 1000 setpoints.bin
#include <glidepath.h>

#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

namespace {

int checked(int result, const char *what) {
    if (result < 0) {
        std::string why(gp_last_error(nullptr, 0) + 1, '\0');
        gp_last_error(&why[0], why.size());
        throw std::runtime_error(std::string(what) + ": " + why.c_str());
    }
    return result;
}

struct Close {
    void operator()(gp_link *link) const { gp_close(link); }
    void operator()(gp_setpoints *setpoints) const { gp_setpoints_close(setpoints); }
};

class Setpoints {
  public:
    explicit Setpoints(const char *instance) {
        gp_link *link = nullptr;
        checked(gp_open(instance, &link), "gp_open");
        link_.reset(link);
        gp_setpoints *setpoints = nullptr;
        checked(gp_setpoints_open(link, &setpoints), "gp_setpoints_open");
        setpoints_.reset(setpoints);
    }

    std::optional<gp_setpoint> next() {
        gp_setpoint setpoint;
        if (checked(gp_next(setpoints_.get(), &setpoint, sizeof setpoint), "gp_next") == 0) {
            return std::nullopt;
        }
        return setpoint;
    }

  private:
    std::unique_ptr<gp_link, Close> link_;
    std::unique_ptr<gp_setpoints, Close> setpoints_;
};

void follow(const char *instance, unsigned long long count, const char *path) {
    using std::chrono::milliseconds;
    Setpoints setpoints(instance);
    std::ofstream file(path, std::ios::binary);
    std::cout << "ready" << std::endl;
    unsigned long long received = 0;
    std::uint64_t lost = 0, expected = 0, boot_id = 0, heard_ns = gp_now_ns();
    while (received < count) {
        const auto setpoint = setpoints.next();
        if (!setpoint) {
            std::this_thread::sleep_for(milliseconds(1));
            if (gp_now_ns() - heard_ns > UINT64_C(10000000000)) {
                throw std::runtime_error("no setpoint for ten seconds");
            }
            continue;
        }
        heard_ns = gp_now_ns();
        if (received > 0 && setpoint->boot_id == boot_id) {
            lost += setpoint->number - expected;
        }
        boot_id = setpoint->boot_id;
        expected = setpoint->number + 1;
        received += 1;
        file.write(reinterpret_cast<const char *>(&*setpoint), sizeof *setpoint);
    }
    file.flush();
    if (!file) {
        throw std::runtime_error(std::string(path) + ": cannot be written");
    }
    std::cout << received << " received, " << lost << " lost" << std::endl;
}

} // namespace

int main(int argc, char **argv) {
    if (argc != 4) {
        std::cerr << "usage: follow INSTANCE COUNT FILE\n";
        return 1;
    }
    try {
        follow(argv[1], std::stoull(argv[2]), argv[3]);
    } catch (const std::exception &error) {
        std::cerr << "follow: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
