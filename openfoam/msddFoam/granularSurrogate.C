/*---------------------------------------------------------------------------*\
    MSDD: multiscale data-driven heat conduction in granular media

    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "granularSurrogate.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The model file is damaged or the inputs are not finite: nothing to go on with
static void failed(const char* what, const std::exception& error)
{
    FatalErrorInFunction
        << "The surrogate model failed on " << what << ": " << error.what()
        << exit(FatalError);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularSurrogate::granularSurrogate
(
    const granularProperties& properties,
    const label cells
)
:
    properties_(properties),
    model_(load(properties)),
    material_
    (
        msdd::material
        (
            properties.thermalConductivity().value(),
            properties.youngModulus().value(),
            properties.meanRadius().value()
        )
    ),
    deltaPorosity_(cells),
    deltaFabricIndex_(cells),
    conductivityXX_(cells),
    conductivityYY_(cells),
    stressXX_(cells),
    stressYY_(cells),
    queries_(0),
    clamped_(0)
{}


msdd::Surrogate Foam::granularSurrogate::load
(
    const granularProperties& properties
)
{
    const dictionary& dict = properties.surrogateDict();

    try
    {
        msdd::Surrogate model(properties.modelPath());

        const std::string& wanted = properties.modelHash();
        if (!wanted.empty() && wanted != model.hash())
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'hash' is " << properties.modelHash() << " but model "
                << properties.model() << " has the hash "
                << model.hash()
                << exit(FatalIOError);
        }
        return model;
    }
    catch (const std::exception& error)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'model' is " << properties.model()
            << ", allowed: builtin, or a readable model file: "
            << error.what() << exit(FatalIOError);
        throw;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularSurrogate::query
(
    const volScalarField& porosity,
    const volScalarField& fabricIndex,
    const volScalarField& thermalStrainIncrement,
    const volScalarField& thermalStrain
)
{
    msdd_batch batch(msdd::batch(deltaPorosity_.size()));

    batch.porosity = porosity.primitiveField().cdata();
    batch.fabric_index = fabricIndex.primitiveField().cdata();
    batch.thermal_strain = thermalStrainIncrement.primitiveField().cdata();
    batch.total_thermal_strain = thermalStrain.primitiveField().cdata();

    batch.delta_porosity = deltaPorosity_.data();
    batch.delta_fabric_index = deltaFabricIndex_.data();
    batch.conductivity_xx = conductivityXX_.data();
    batch.conductivity_yy = conductivityYY_.data();
    batch.stress_xx = stressXX_.data();
    batch.stress_yy = stressYY_.data();

    try
    {
        model_.evaluate(material_, batch);
    }
    catch (const std::exception& error)
    {
        failed("the state of the cells", error);
    }

    ++queries_;
    clamped_ += batch.clamped_cells;
}


void Foam::granularSurrogate::advance
(
    volScalarField& porosity,
    volScalarField& fabricIndex
) const
{
    porosity.primitiveFieldRef() += deltaPorosity_;
    porosity.correctBoundaryConditions();

    fabricIndex.primitiveFieldRef() += deltaFabricIndex_;
    fabricIndex.correctBoundaryConditions();
}


void Foam::granularSurrogate::conductivity(volSymmTensorField& K) const
{
    symmTensorField& cells = K.primitiveFieldRef();

    forAll(cells, celli)
    {
        cells[celli].xx() = conductivityXX_[celli];
        cells[celli].yy() = conductivityYY_[celli];
    }
    K.correctBoundaryConditions();
}


void Foam::granularSurrogate::stress(volSymmTensorField& sigma) const
{
    symmTensorField& cells = sigma.primitiveFieldRef();

    forAll(cells, celli)
    {
        // The one place where compression positive becomes tension positive
        cells[celli].xx() = -stressXX_[celli];
        cells[celli].yy() = -stressYY_[celli];
    }
    sigma.correctBoundaryConditions();
}


Foam::tmp<Foam::scalarField> Foam::granularSurrogate::solidFraction
(
    const scalarField& porosity
) const
{
    tmp<scalarField> tfraction(new scalarField(porosity.size()));

    try
    {
        model_.solidFraction
        (
            porosity.size(),
            porosity.cdata(),
            tfraction.ref().data()
        );
    }
    catch (const std::exception& error)
    {
        failed("the initial porosity", error);
    }
    return tfraction;
}


std::string Foam::granularSurrogate::hash() const
{
    return model_.hash();
}


int64_t Foam::granularSurrogate::clampedQueries() const
{
    return returnReduce(clamped_, sumOp<int64_t>());
}


// ************************************************************************* //
