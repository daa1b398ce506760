#include "amble/browser/interface.hpp"

#include <memory>
#include <span>
#include <string>
#include <utility>

#include "amble/browser/evolution.hpp"
#include "amble/browser/fused_check.hpp"
#include "amble/browser/session.hpp"
#include "amble/browser/texts.hpp"
#include "amble/core/check.hpp"
#include "amble/core/hash.hpp"

namespace {

std::string text, result;
std::unique_ptr<amble::browser::Session> session;
std::string evolved;
std::unique_ptr<amble::browser::Evolution> evolution;

amble::browser::Session& open_session() {
  AMBLE_CHECK(session != nullptr, "a champion is opened first");
  return *session;
}

amble::browser::Evolution& started_evolution() {
  AMBLE_CHECK(evolution != nullptr, "an evolution is started first");
  return *evolution;
}

}  // namespace

namespace amble::browser {

const std::string& taken_text() {
  return text;
}
void give_text(std::string given) {
  result = std::move(given);
}

}  // namespace amble::browser

char* amble_text(std::size_t size) {
  text.assign(size, '\0');
  return text.data();
}
const char* amble_result() {
  return result.data();
}
std::size_t amble_result_size() {
  return result.size();
}

void amble_open() {
  session = std::make_unique<amble::browser::Session>(text);
}
void amble_restart(int as_evolved) {
  open_session().restart(as_evolved != 0);
}
void amble_push(double x_n_s, double y_n_s, double z_n_s) {
  open_session().push({x_n_s, y_n_s, z_n_s});
}
void amble_lift(double height_m) {
  open_session().lift(height_m);
}
void amble_command(double speed_m_s, double turn_rad_s) {
  open_session().command({static_cast<float>(speed_m_s), static_cast<float>(turn_rad_s)});
}
void amble_set_ground() {
  open_session().set_ground(text);
}
void amble_set_damage() {
  open_session().set_damage(text);
}
int amble_step(int count) {
  return open_session().step(count);
}

void amble_describe() {
  result = open_session().describe();
}
void amble_inputs() {
  result = open_session().inputs();
}
void amble_hash() {
  result = amble::hex(amble::hash_span(std::span(open_session().trace())));
}

void amble_evolution_of() {
  evolved = text;
}
void amble_evolve() {
  evolution = std::make_unique<amble::browser::Evolution>(evolved, text);
}
int amble_evolution_advance(int steps) {
  return started_evolution().advance(steps);
}
void amble_evolution_progress() {
  result = started_evolution().progress_json();
}
void amble_evolution_champion() {
  result = started_evolution().champion();
}

const double* amble_state() {
  return open_session().state().data();
}
const float* amble_heights() {
  return open_session().heights_m();
}
int amble_steps_as_recorded() {
  return open_session().steps_as_recorded();
}
int amble_is_exact() {
  return amble::browser::is_fused();
}
