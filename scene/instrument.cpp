#include "scene/instrument.h"

#include <vtkActor.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>

namespace palpa::scene {
namespace {

void dress(vtkActor& actor, const vtkSmartPointer<vtkPolyData>& mesh, double specular) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  actor.SetMapper(mapper);
  actor.GetProperty()->SetAmbient(0.22);
  actor.GetProperty()->SetDiffuse(0.78);
  actor.GetProperty()->SetSpecular(specular);
  actor.GetProperty()->SetSpecularPower(40);
}

Pose shifted(const Pose& X, double z) { return X * Eigen::Translation3d(0, 0, z); }

}  // namespace

void copy(const Pose& X, vtkMatrix4x4& matrix) {
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) matrix.SetElement(row, column, X(row, column));
}

Instrument::Instrument(vtkRenderer& renderer) {
  dress(*needle_, needleShape(size_), 0.45);
  dress(*barrel_, barrelShape(size_), 0.6);
  dress(*plunger_, plungerShape(size_), 0.2);
  dress(*blood_, bloodShape(size_), 0.3);
  dress(*probe_, probeShape({}), 0.35);
  barrel_->GetProperty()->SetOpacity(0.28);
  needle_->GetProperty()->SetLineWidth(1.5);
  needle_->SetUserMatrix(X_AT_);
  barrel_->SetUserMatrix(X_AT_);
  probe_->SetUserMatrix(X_AT_);
  plunger_->SetUserMatrix(X_A_plunger_);
  blood_->SetUserMatrix(X_A_blood_);
  for (vtkActor* actor : {needle_.Get(), plunger_.Get(), blood_.Get(), probe_.Get(), barrel_.Get()})
    renderer.AddActor(actor);
}

Instrument::~Instrument() = default;

void Instrument::update(const Pose& X_AT, double plunger, double blood) {
  const double drawn = std::clamp(plunger, 0.0, 1.0) * size_.stroke;
  const double column = std::min(std::clamp(blood, 0.0, 1.0) * size_.stroke, drawn);
  has_blood_ = column > 1e-4;
  copy(X_AT, *X_AT_);
  copy(shifted(X_AT, -drawn), *X_A_plunger_);
  copy(shifted(X_AT, size_.barrel_front), *X_A_blood_);
  for (int row = 0; row < 3; ++row)
    X_A_blood_->SetElement(row, 2, column * X_A_blood_->GetElement(row, 2));
}

void Instrument::show(Tool tool) {
  const bool needle = tool == Tool::needle;
  for (vtkActor* actor : {needle_.Get(), plunger_.Get(), barrel_.Get()})
    actor->SetVisibility(needle);
  blood_->SetVisibility(needle && has_blood_);
  probe_->SetVisibility(tool == Tool::probe);
}

void Instrument::hide() {
  for (vtkActor* actor : {needle_.Get(), plunger_.Get(), barrel_.Get(), blood_.Get(), probe_.Get()})
    actor->VisibilityOff();
}

InstrumentSilhouette::InstrumentSilhouette(vtkRenderer& renderer) {
  dress(*needle_, silhouetteShape({}), 0.1);
  dress(*probe_, probeShape({}), 0.1);
  for (vtkActor* actor : {needle_.Get(), probe_.Get()}) {
    actor->GetProperty()->SetAmbient(0.5);
    actor->GetProperty()->SetDiffuse(0.5);
    actor->SetUserMatrix(X_AT_);
    renderer.AddActor(actor);
  }
  show(Tool::needle);
}

InstrumentSilhouette::~InstrumentSilhouette() = default;

void InstrumentSilhouette::update(const Pose& X_AT) { copy(X_AT, *X_AT_); }

void InstrumentSilhouette::show(Tool tool) {
  needle_->SetVisibility(tool == Tool::needle);
  probe_->SetVisibility(tool == Tool::probe);
}

void InstrumentSilhouette::hide() {
  needle_->VisibilityOff();
  probe_->VisibilityOff();
}

}  // namespace palpa::scene
